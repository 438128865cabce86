#include "report/browser.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "support/temporary_folder.h"

namespace importon::test {
namespace {

/// Before all else in the page: keeps errors. Nothing may be fetched, so a request is an error too.
constexpr const char* kBefore = R"(<head><script>
window.visit = { errors: [], result: '' };
window.tell = text => { window.visit.result += text; };
window.addEventListener('error', e => window.visit.errors.push(e.message || 'not loaded: ' + (e.target.src || e.target.href)), true);
window.addEventListener('unhandledrejection', e => window.visit.errors.push(String(e.reason)));
for (const kind of ['error', 'warn']) console[kind] = (...words) => window.visit.errors.push(words.join(' '));
</script>)";

/// After all else: runs the script, and leaves what it found where --dump-dom shows it.
std::string after(const std::string& script) {
  return "<script>window.addEventListener('load', () => { try {" + script +
         R"(} catch (e) { window.visit.errors.push(String(e)); }
const out = document.createElement('pre');
out.id = 'visit';
out.textContent = btoa(unescape(encodeURIComponent(JSON.stringify(window.visit))));
document.body.replaceChildren(out); });</script></body>)";
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.rfind(what);
  if (at == std::string::npos) throw std::runtime_error("the page has no " + what);
  return text.replace(at, what.size(), with);
}

std::string outputOf(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe) throw std::runtime_error("cannot run " + command);
  std::string output;
  std::array<char, 4096> piece{};
  while (const std::size_t count = fread(piece.data(), 1, piece.size(), pipe.get())) output.append(piece.data(), count);
  return output;
}

std::string fromBase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned word = 0, bits = 0;
  for (const char c : text) {
    const std::size_t digit = digits.find(c);
    if (digit == std::string::npos) break;
    word = word << 6 | static_cast<unsigned>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(word >> bits & 255);
  }
  return bytes;
}

}  // namespace

std::optional<std::string> findBrowser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
    if (std::system((std::string("command -v ") + name + " > /dev/null 2>&1").c_str()) == 0) return name;
  }
  return {};
}

PageVisit visitPage(const std::string& browser, const std::string& page, const std::string& script) {
  const TemporaryFolder folder;
  writeFile(folder / "page.html", replaced(replaced(page, "</body>", after(script)), "<head>", kBefore));
  const std::string dom =
      outputOf(browser + " --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --window-size=1200,900 " +
               "--user-data-dir='" + (folder / "profile").string() +
               "' --host-resolver-rules='MAP * ~NOTFOUND' --virtual-time-budget=5000 --dump-dom 'file://" +
               (folder / "page.html").string() + "' 2> '" + (folder / "log").string() + "'");
  const std::string mark = "<pre id=\"visit\">";
  const std::size_t at = dom.find(mark);
  if (at == std::string::npos) throw std::runtime_error("the browser gave no page: " + readFile(folder / "log"));
  const auto visit = nlohmann::json::parse(fromBase64(dom.substr(at + mark.size())));
  PageVisit result;
  for (const auto& error : visit["errors"]) result.errors += error.get<std::string>() + "\n";
  result.result = visit["result"];
  return result;
}

}  // namespace importon::test
