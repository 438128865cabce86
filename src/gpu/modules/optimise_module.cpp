/// Makes a SPIR-V module small before a driver sees it:
///   importon_optimise_module MODULE OPTIMISED LEAN PLACED [FOLDER]
/// A driver specialises a module whenever a program starts, and many do it after inlining all functions: here that is
/// done once, with the constants left open. LEAN is the same module with the constants of rare features
/// (kSpecFirstRare) taken for false, or an empty file if it has none: what most scenes never need is not in it at all.
/// PLACED is that for scenes that need kSpecHasInstances alone of these, or an empty file where it makes no difference.
/// All of them are made for lanes that go through them together (close_loops.h, flatten_branches.h). Throws at a module
/// that is not valid for Vulkan 1.2 with scalar block layout. FOLDER keeps what was made, for builds that make the
/// same: it takes seconds.
#include <spirv_cross/spirv.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <set>
#include <span>
#include <spirv-tools/optimizer.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/hash.h"
#include "gpu/modules/close_loops.h"
#include "gpu/modules/flatten_branches.h"
#include "gpu/modules/portable_arithmetic.h"
#include "shared/features.h"

namespace {

using Words = std::vector<std::uint32_t>;

constexpr std::size_t kHeaderWords = 5;
// No pass that rewrites arithmetic (--simplify-instructions): see docs/experiments/start-up.md.
const std::vector<std::string> kOpen{
    "--merge-return", "--inline-entry-points-exhaustive", "--eliminate-dead-functions",
    "--eliminate-dead-code-aggressive",
    // Variables of functions become values.
    "--private-to-local", "--eliminate-local-single-block", "--eliminate-local-single-store",
    "--eliminate-dead-code-aggressive", "--scalar-replacement=100", "--convert-local-access-chains",
    "--eliminate-local-single-block", "--eliminate-local-single-store", "--eliminate-dead-code-aggressive",
    "--ssa-rewrite", "--eliminate-dead-code-aggressive"};
// What is constant, unused or computed twice goes.
const std::vector<std::string> kClosed{"--ccp",
                                       "--eliminate-dead-code-aggressive",
                                       "--eliminate-dead-branches",
                                       "--redundancy-elimination",
                                       "--combine-access-chains",
                                       "--vector-dce",
                                       "--eliminate-dead-inserts",
                                       "--merge-blocks"};

Words read(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  Words words(bytes.size() / sizeof(Words::value_type));
  std::copy_n(bytes.begin(), words.size() * sizeof(Words::value_type), reinterpret_cast<char*>(words.data()));
  return words;
}

void write(const std::filesystem::path& file, const Words& words) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(words.data()),
               static_cast<std::streamsize>(words.size() * sizeof(Words::value_type)));
  if (!stream.flush()) throw std::runtime_error("cannot write " + file.string());
}

enum class Instances { left, taken };  // out, or for true

/// The module with its rare constants, which are Booleans, as the constant false, but for that of instances; empty: it
/// has none, or none of instances to take for true. Decorations come before constants. [SPIR-V 1.5, 2.4]
Words withoutRare(const Words& module, Instances instances) {
  Words lean(module.begin(), module.begin() + kHeaderWords);
  std::set<std::uint32_t> rare;
  std::uint32_t placed = 0;  // id of the constant of instances
  for (std::uint32_t at = kHeaderWords, count = 0; at < module.size(); at += count) {
    count = module[at] >> SpvWordCountShift;
    const std::uint32_t operation = module[at] & SpvOpCodeMask;
    if (count == 0 || count > module.size() - at) throw std::runtime_error("an instruction ends beyond the module");
    if (operation == SpvOpDecorate && module[at + 2] == SpvDecorationSpecId &&
        module[at + 3] >= importon::kSpecFirstRare) {
      rare.insert(module[at + 1]);
      if (module[at + 3] == importon::kSpecHasInstances) placed = module[at + 1];
      continue;
    }
    const std::size_t to = lean.size();
    lean.insert(lean.end(), module.begin() + at, module.begin() + at + count);
    if ((operation == SpvOpSpecConstantTrue || operation == SpvOpSpecConstantFalse) && rare.contains(module[at + 2])) {
      const bool isTrue = instances == Instances::taken && module[at + 2] == placed;
      lean[to] = count << SpvWordCountShift | (isTrue ? SpvOpConstantTrue : SpvOpConstantFalse);
    }
  }
  const bool isWanted = instances == Instances::taken ? placed != 0 : !rare.empty();
  return isWanted ? lean : Words();
}

void tell(spv_message_level_t, const char*, const spv_position_t& at, const char* message) {
  std::cerr << "word " << at.index << ": " << message << "\n";
}

spvtools::ValidatorOptions scalarLayout() {
  spvtools::ValidatorOptions options;
  options.SetScalarBlockLayout(true);
  return options;
}

Words validated(Words module) {
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_2);
  tools.SetMessageConsumer(tell);
  if (!tools.Validate(module.data(), module.size(), scalarLayout())) throw std::runtime_error("is not valid");
  return module;
}

Words optimised(const Words& module, const std::vector<std::string>& passes) {
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_2);
  optimizer.SetMessageConsumer(tell);
  if (!optimizer.RegisterPassesFromFlags(passes)) throw std::runtime_error("an unknown pass");
  spvtools::OptimizerOptions options;
  options.set_run_validator(false);  // a tenth of all time each; the first and the last module are looked at
  Words result;
  if (!optimizer.Run(module.data(), module.size(), &result, options)) throw std::runtime_error("cannot be optimised");
  return result;
}

Words portable(const Words& module) {
  importon::gpu::ModuleBlocks blocks = importon::gpu::blocksOf(module);
  importon::gpu::makePortable(blocks);
  return blocks.words();
}

/// Made such that it runs right, and is compiled soon, where lanes go through it together.
Words forLanes(const Words& module) {
  importon::gpu::ModuleBlocks blocks = importon::gpu::blocksOf(module);
  importon::gpu::flattenBranches(blocks);
  importon::gpu::closeLoops(blocks);
  return blocks.words();
}

/// Whole, lean and placed.
using Modules = std::array<Words, 3>;

/// The passes that do not look at constants take longest, and are alike for all three.
Modules optimisedAll(const Words& module) {
  const Words open = portable(optimised(validated(module), kOpen));
  Modules modules{open, withoutRare(open, Instances::left), withoutRare(open, Instances::taken)};
  for (Words& each : modules)
    if (!each.empty()) each = validated(forLanes(optimised(each, kClosed)));
  return modules;
}

/// By all that a result depends on.
std::filesystem::path fileFor(const Words& module, const std::filesystem::path& folder) {
  importon::ContentHash hash;
  hash.add(IMPORTON_OPTIMISER);  // this source and the rare constants
  hash.add(spvSoftwareVersionDetailsString());
  hash.add(std::as_bytes(std::span(module)));
  std::ostringstream name;
  name << std::hex << hash.value();
  return folder / name.str();
}

/// Of what keep() wrote; all empty if there is nothing.
Modules readKept(const std::filesystem::path& file) {
  const Words words = read(file);
  Modules modules;
  auto at = words.begin();
  for (Words& each : modules) {
    const auto left = static_cast<std::size_t>(words.end() - at);
    if (left == 0 || *at >= left) return {};
    const std::uint32_t size = *at++;
    each.assign(at, at + size);
    at += size;
  }
  return modules;
}

/// Each with its size before it. Other builds see the whole file or none.
void keep(const Modules& modules, const std::filesystem::path& file) {
  Words words;
  for (const Words& each : modules) {
    words.push_back(static_cast<std::uint32_t>(each.size()));
    words.insert(words.end(), each.begin(), each.end());
  }
  std::filesystem::create_directories(file.parent_path());
  const std::filesystem::path part = file.string() + "." + std::to_string(getpid());
  write(part, words);
  std::filesystem::rename(part, file);
}

Modules optimisedOnce(const Words& module, const std::filesystem::path& folder) {
  const std::filesystem::path file = fileFor(module, folder);
  Modules modules = readKept(file);
  if (modules[0].empty()) {
    modules = optimisedAll(module);
    keep(modules, file);
  }
  return modules;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    if (count != 5 && count != 6) throw std::runtime_error("MODULE OPTIMISED LEAN PLACED [FOLDER] are wanted");
    const Words module = read(arguments[1]);
    if (module.size() < kHeaderWords) throw std::runtime_error("no module");
    const Modules modules = count == 6 ? optimisedOnce(module, arguments[5]) : optimisedAll(module);
    for (std::size_t i = 0; i < modules.size(); ++i) write(arguments[2 + i], modules[i]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "importon_optimise_module: " << (count > 1 ? arguments[1] : "") << ": " << error.what() << "\n";
    return 1;
  }
}
