// A library that does all that ours must not: the check of symbols has to report each.
#include <cstdio>
#include <cstdlib>
#include <iostream>

int prints(int argc) {
  std::printf("%d\n", argc);
  std::fputs("error\n", stderr);
  std::cout << argc;
  if (argc == 3) std::abort();
  if (argc == 2) std::exit(3);
  return argc + static_cast<int>(std::string("some more symbols").size());
}
