// The page of converge in a browser.
#include <gtest/gtest.h>

#include <stdexcept>

#include "report/browser.h"
#include "report/sample_report.h"

namespace importon {
namespace {

using test::greyRow;
using test::PageVisit;

class ConvergePage : public ::testing::Test {
 protected:
  void SetUp() override {
    browser_ = test::findBrowser();
    if (!browser_) GTEST_SKIP() << "no Chromium: apt-get install chromium";
  }
  PageVisit visit(const std::string& script) {
    return test::visitPage(*browser_, convergePage(test::sampleTitle(), test::sampleReport(), greyRow({0.5F, 0.5F})),
                           script);
  }

 private:
  std::optional<std::string> browser_;
};

TEST_F(ConvergePage, LoadsWithoutErrorsOrANetwork) {
  const PageVisit page = visit(
      "tell(document.querySelectorAll('#plot circle').length + ' points, ' + "
      "document.querySelectorAll('#plot .curve').length + ' curves, ' + "
      "[...document.images].every(i => i.complete && i.naturalWidth === 2));");
  EXPECT_EQ(page.errors, "");
  EXPECT_EQ(page.result, "12 points, 2 curves, true");
}

TEST_F(ConvergePage, NoticesErrors) {
  const PageVisit page = visit("console.error('from the console'); nothingOfThatName();");
  EXPECT_NE(page.errors.find("from the console"), std::string::npos);
  EXPECT_NE(page.errors.find("nothingOfThatName"), std::string::npos);
}

TEST_F(ConvergePage, TellsOfAPointUnderThePointer) {
  const PageVisit page = visit(
      "const dot = document.querySelector('#plot g[data-config=\"a<b\"] circle'), tip = document.getElementById('tip');"
      "dot.dispatchEvent(new PointerEvent('pointerenter', { clientX: 9, clientY: 9 }));"
      "tell(getComputedStyle(tip).display + ': ' + tip.textContent.split('\\n').slice(0, 3).join(' | ') + ' | ' +"
      "document.querySelectorAll('#plot g.dim').length);"
      "dot.dispatchEvent(new PointerEvent('pointerleave')); tell(' then ' + getComputedStyle(tip).display);");
  EXPECT_EQ(page.errors, "");
  EXPECT_EQ(page.result, "block: a<b, seed 1 | 1 s, 10 passes, 1000 photons | trimmed relMSE 0.64 | 1 then none");
}

TEST_F(ConvergePage, DrawsOtherErrorsAndAxes) {
  const PageVisit page = visit(
      "const choose = (id, value) => { const e = document.getElementById(id); e.value = value;"
      "e.dispatchEvent(new Event('change')); };"
      "choose('metric', 'smape'); choose('axis', 'memory');"
      "const texts = [...document.querySelectorAll('#plot text')].map(t => t.textContent);"
      "tell(texts.includes('SMAPE') + ' ' + texts.includes('bytes on the device'));"
      "document.querySelector('#legend span').click();"
      "tell(' ' + document.querySelectorAll('#plot .curve').length);");
  EXPECT_EQ(page.errors, "");
  EXPECT_EQ(page.result, "true true 1");
}

TEST_F(ConvergePage, WipesBetweenImages) {
  const PageVisit page = visit(
      "const box = document.getElementById('wipe').getBoundingClientRect(), over = document.getElementById('over');"
      "document.getElementById('wipe').dispatchEvent(new PointerEvent('pointermove',"
      "{ buttons: 1, clientX: box.left + 0.25 * box.width, clientY: box.top + 1 }));"
      "tell(over.style.clipPath + ' ' + document.getElementById('bar').style.left);"
      "const slider = document.getElementById('slider'); slider.value = 90; slider.dispatchEvent(new Event('input'));"
      "tell(' ' + over.style.clipPath);");
  EXPECT_EQ(page.errors, "");
  EXPECT_EQ(page.result, "inset(0px 75% 0px 0px) calc(25% - 1px) inset(0px 10% 0px 0px)");
}

TEST_F(ConvergePage, ShowsErrorsInsteadOfImages) {
  const PageVisit page = visit(
      "const top = document.getElementById('top'), before = top.src, box = document.getElementById('errors');"
      "box.checked = true; box.dispatchEvent(new Event('change'));"
      "tell((top.src !== before && top.src === data.images[1].error) + ' ' + data.images[1].name);");
  EXPECT_EQ(page.errors, "");
  EXPECT_EQ(page.result, "true default");
}

TEST_F(ConvergePage, HasTheTables) {
  const PageVisit page = visit(
      "tell([...document.querySelectorAll('#settings tr')].map(r => r.cells[0].textContent + ':' +"
      "r.cells[1].textContent).join(' '));"
      "tell(' | ' + document.querySelector('#times tr:last-child td:last-child').textContent);"
      "tell(' | ' + document.querySelectorAll('#parts tr').length);");
  EXPECT_EQ(page.errors, "");
  EXPECT_EQ(page.result, "configuration:options default:defaults a<b:--control off | not reached | 7");
}

// The reference's own error is 0.003: the first error of the first configuration, 0.16, is above ten times that; its
// last one, 0.01, and the level of 0.02 are below.
TEST_F(ConvergePage, TellsWhatTheReferenceIsTooNoisyFor) {
  const PageVisit page = visit(
      "const cells = (table, row) => [...document.querySelectorAll(table + ' tr')[row].cells].map(c => c.textContent);"
      "tell([cells('#parts', 1)[3], cells('#parts', 3)[3], cells('#parts', 3)[4], cells('#times', 1)[3]].join(' | '));"
      "tell(' | ' + document.getElementById('floor').textContent.slice(0, 36));");
  EXPECT_EQ(page.errors, "");
  EXPECT_EQ(page.result, "0.16 (0.16 … 0.16) | < 0.01 | < 0.01 | not known | The reference's own error is 0.003: ");
}

TEST_F(ConvergePage, TellsWhatIsNotKnownWithinAFactorOfTwo) {
  const PageVisit page = visit(
      "tell([withInterval({ mean: 1, low: 0.6, high: 1.6 }), withInterval({ mean: 1, low: 0.4, high: 2.2 }),"
      "withInterval({ mean: 1, low: null, high: null })].join(' | '));");
  EXPECT_EQ(page.errors, "");
  EXPECT_EQ(page.result, "1 (0.6 … 1.6) | not known | 1");
}

}  // namespace
}  // namespace importon
