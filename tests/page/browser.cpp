#include "tests/page/browser.h"

#include "tests/io/temporary_folder.h"

#include <cstdlib>
#include <stdexcept>

namespace dsc::test {

bool has_browser() {
#ifdef DSC_CHROMIUM
  return true;
#else
  return false;
#endif
}

nlohmann::json self_test([[maybe_unused]] const std::string& path,
                         [[maybe_unused]] const std::string& wishes) {
#ifdef DSC_CHROMIUM
  const TemporaryFolder folder;
  // --no-sandbox, since root may run the tests; the page is our own. Virtual time ends once nothing
  // is left to do.
  const std::string command =
      std::string("HOME='") + folder.path() +
      "' timeout 300 " DSC_CHROMIUM " --headless --no-sandbox " + kSoftwareWebGl +
      " --window-size=1200,800 --virtual-time-budget=60000 --user-data-dir='" +
      (folder / "profile") + "' --dump-dom 'file://" + path + "#selftest&" + wishes + "' > '" +
      (folder / "dom") + "' 2> '" + (folder / "errors") + "'";
  const int code = std::system(command.c_str());
  const std::string dom = read_all(folder / "dom");
  const std::string mark = "<pre id=\"selftest\" hidden=\"\">";
  const std::size_t at = dom.find(mark);
  if (code != 0 || at == std::string::npos) {
    throw std::runtime_error("the page said nothing: " + read_all(folder / "errors"));
  }
  const std::size_t from = at + mark.size();
  std::string text = dom.substr(from, dom.find("</pre>", from) - from);
  for (const auto& [escaped, plain] : {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}}) {
    for (std::size_t i = 0; (i = text.find(escaped, i)) != std::string::npos; ++i) {
      text.replace(i, std::string(escaped).size(), plain);
    }
  }
  return nlohmann::json::parse(text);
#else
  throw std::runtime_error(kNoBrowser);
#endif
}

bool can_drive() {
#if defined(DSC_CHROMIUM) && defined(DSC_NODE)
  return true;
#else
  return false;
#endif
}

nlohmann::json drive([[maybe_unused]] const nlohmann::json& steps,
                     [[maybe_unused]] const std::string& flags) {
#if defined(DSC_CHROMIUM) && defined(DSC_NODE)
  const TemporaryFolder folder;
  write_all(folder / "steps.json", steps.dump());
  const std::string command =
      std::string("HOME='") + folder.path() +
      "' timeout 300 " DSC_NODE " " DSC_PAGE_TESTS "/drive.js " DSC_CHROMIUM " '" +
      (folder / "steps.json") + "' '" + (folder / "profile") + "' --window-size=1200,800 " + flags +
      " > '" + (folder / "out") + "' 2> '" + (folder / "errors") + "'";
  if (std::system(command.c_str()) != 0) {
    throw std::runtime_error("the page was not driven: " + read_all(folder / "errors"));
  }
  return nlohmann::json::parse(read_all(folder / "out"));
#else
  throw std::runtime_error(kNoDriver);
#endif
}

}  // namespace dsc::test
