// A library that does all that ours must not: the check of symbols has to report each.
#undef NDEBUG
#include <cassert>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include <unistd.h>

int prints(int argc) {
  assert(argc != 9);
  std::printf("%d\n", argc);
  std::puts("a line");
  std::putchar('c' + argc);
  std::fputs("error\n", stderr);
  std::perror("error");
  ::psignal(argc, "signal");
  ::dprintf(2, "%d\n", argc);
  std::cout << argc;
  std::clog << argc;
  if (argc == 8) std::raise(argc);
  if (argc == 7) (void)std::system("true");
  if (argc == 6) ::_exit(argc);
  if (argc == 5) return ::fork();
  if (argc == 4) return ::execl("/bin/true", "true", nullptr);
  if (argc == 3) std::abort();
  if (argc == 2) std::exit(3);
  return argc + static_cast<int>(std::string("some more symbols").size());
}
