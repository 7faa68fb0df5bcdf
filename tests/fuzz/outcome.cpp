#include "libdsc/base/error.h"
#include "tests/fuzz/fuzz.h"

#include <algorithm>

namespace dsc::fuzz {

std::string outcome(void (*target)(std::string_view), std::string_view bytes) {
  const auto judged = [](const Error& error, bool of_a_file) {
    std::string text = error.what();
    require(!text.empty(), "an error has a message");
    if (of_a_file) {
      require(text.size() < 1000, "a message is short, whatever the file holds");
      require(std::all_of(text.begin(), text.end(), [](char c) { return c >= 32 && c < 127; }),
              "a message is printable, whatever the file holds");
      require(text.find("'fuzz.") != std::string::npos, "a message names the file");
    }
    return text;
  };
  try {
    target(bytes);
    return "";
  } catch (const UsageError& error) {  // repeats what the user typed
    return judged(error, false);
  } catch (const InputError& error) {
    return judged(error, std::string_view(error.what()).substr(0, 10) != "expression");
  } catch (const LimitError& error) {
    return judged(error, false);
  }
}

}  // namespace dsc::fuzz
