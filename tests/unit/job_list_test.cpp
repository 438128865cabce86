#include "app/batch/job_list.h"

#include <gtest/gtest.h>

#include "app/batch/job_files.h"
#include "base/error.h"
#include "gpu/kernel_cache.h"
#include "support/temporary_folder.h"

namespace importon::job_list_test {
namespace {

using Words = std::vector<std::string>;

Words split(const std::string& line) { return splitListLine(line, "l:1"); }

TEST(JobList, CutsALineIntoWords) {
  EXPECT_EQ(split(""), Words{});
  EXPECT_EQ(split("  a.glb\t--width 3 \r"), (Words{"a.glb", "--width", "3"}));
  EXPECT_EQ(split("a.glb#b # c 'd"), (Words{"a.glb#b"}));
  EXPECT_EQ(split("'a b.glb' \"it's\" x\"y z\"'w'"), (Words{"a b.glb", "it's", "xy zw"}));
  EXPECT_EQ(split("'#a' ''"), (Words{"#a", ""}));
  EXPECT_EQ(split("café.glb"), (Words{"café.glb"}));
  for (const char* bad : {"'a", "a \"", "a\x01", "a\x7f"}) EXPECT_THROW((void)split(bad), UsageError) << bad;
}

TEST(JobList, KeepsTheNumbersOfLines) {
  const test::TemporaryFolder folder;
  test::writeFile(folder / "l", "\n# c\na.glb\n\nb.glb --width 3");
  const std::vector<ListLine> lines = readJobList(folder / "l");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].number, 3);
  EXPECT_EQ(lines[1].number, 5);
  EXPECT_EQ(lines[1].words, (Words{"b.glb", "--width", "3"}));
}

TEST(JobFiles, NamesCamerasByWhatIsFitAndTheirOwn) {
  std::vector<Camera> cameras(7);
  const std::array names{"top", "", "7", "a/b", "twin", "twin", "café no. 1"};
  for (std::size_t i = 0; i < names.size(); ++i) cameras[i].name = names[i];
  const std::array expected{"top", "1", "2", "3", "4", "5", "café no. 1"};
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(cameraLabel(cameras, i), expected[i]);
  cameras[0].name = std::string(101, 'x');
  EXPECT_EQ(cameraLabel(cameras, 0), "0");
}

TEST(JobFiles, PutsTheCameraBeforeTheExtension) {
  RenderJob job;
  job.scene = "x/a.b.glb";
  nameOutputs(job, "out", "png", "");
  EXPECT_EQ(job.output, "out/a.b.exr");
  EXPECT_EQ(job.png, "png/a.b.png");
  RenderJob named;
  named.scene = "a.glb";
  named.output = "large.exr";
  nameOutputs(named, "out", "png", "top/left");
  EXPECT_EQ(named.output, "large.exr");
  EXPECT_EQ(named.png, "png/large.png");
  addCamera(job, "top");
  EXPECT_EQ(job.output, "out/a.b.top.exr");
  EXPECT_EQ(job.png, "png/a.b.top.png");
  EXPECT_EQ(job.stats, "");
}

TEST(KernelCache, ReadsTheConstantsThatAModuleDeclares) {
  constexpr std::uint32_t kDecorate4 = 4u << 16 | 71, kDecorate3 = 3u << 16 | 71, kName = 3u << 16 | 5;
  const std::vector<std::uint32_t> module{0x07230203, 0x10500, 0, 9,          0,          // the header
                                          kName,      71,      1, kDecorate4, 6, 1,  30,  // SpecId 30
                                          kDecorate3, 7,       2, kDecorate4, 8, 33, 2,   // Block; Binding 2
                                          kDecorate4, 5,       1, 4};
  EXPECT_EQ(gpu::declaredConstants(module), (std::vector<std::uint32_t>{4, 30}));
  EXPECT_THROW((void)gpu::declaredConstants(std::span(module).first(9)), std::logic_error) << "cut off";
}

}  // namespace
}  // namespace importon::job_list_test
