// The GL context without a window, and what is made with it: programs, buffers, textures, in any order of ending.
#include "sim/gpu/context.h"

#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "sim/base/failure.h"
#include "sim/gpu/buffer.h"
#include "sim/gpu/fence.h"
#include "sim/gpu/program.h"
#include "sim/gpu/texture.h"

namespace seldinger::gpu {
namespace {

constexpr const char* kCopyText = R"(#version 430 core
layout(local_size_x = 1) in;
layout(binding = 2) uniform isampler2DArray volume;
layout(std140, binding = 3) uniform Block { ivec4 add; };
layout(std430, binding = 4) writeonly buffer Out { int values[]; };
void main() {
  ivec3 at = ivec3(gl_WorkGroupID);
  ivec3 size = ivec3(gl_NumWorkGroups);
  values[(at.z * size.y + at.y) * size.x + at.x] = texelFetch(volume, at, 0).x + add.y;
})";

// Odd sizes, so that a row is no multiple of four bytes.
constexpr glm::ivec3 kSize{5, 3, 7};

std::vector<std::int16_t> numbers() {
  std::vector<std::int16_t> values(105);
  std::iota(values.begin(), values.end(), std::int16_t{-1024});
  return values;
}

struct Copier {
  explicit Copier(Context& context)
      : program(context, kCopyText),
        volume(context, kSize, numbers()),
        add(context, BufferUse::uniform, 16),
        out(context, BufferUse::storage, 105 * sizeof(int)) {}

  std::vector<int> run(int added) {
    const int block[4] = {0, added, 0, 0};
    add.write(std::as_bytes(std::span(block)));
    volume.bind(2);
    add.bind(3);
    out.bind(4);
    program.dispatch(kSize.x, kSize.y, kSize.z);
    std::vector<int> result(105);
    out.read(std::as_writable_bytes(std::span(result)));
    return result;
  }

  Program program;
  Texture volume;
  Buffer add, out;
};

std::vector<int> expected(int added) {
  std::vector<int> values(105);
  std::iota(values.begin(), values.end(), added - 1024);
  return values;
}

TEST(Context, IsAtLeastGl43AndSaysWhoDraws) {
  const Context context;
  EXPECT_FALSE(context.renderer().empty());
  ASSERT_GE(context.version().size(), 3U);
  const int major = context.version()[0] - '0', minor = context.version()[2] - '0';
  EXPECT_GE(10 * major + minor, 43) << context.version();
  EXPECT_TRUE(context.software() || context.renderer().find("llvmpipe") == std::string::npos);
}

TEST(Context, RunsAProgramOverAnIntegerVolume) {
  Context context;
  Copier copier(context);
  EXPECT_EQ(copier.run(0), expected(0));
  EXPECT_EQ(copier.run(-500), expected(-500));
}

TEST(Context, OneAfterAnother) {
  for (int i = 0; i < 8; ++i) {
    Context context;
    EXPECT_EQ(Copier(context).run(i), expected(i));
  }
}

TEST(Context, TwoAtOnceDoNotMixTheirObjects) {
  Context first, second;
  Copier of_first(first);
  auto of_second = std::make_unique<Copier>(second);
  EXPECT_EQ(of_first.run(1), expected(1));
  EXPECT_EQ(of_second->run(2), expected(2));
  of_second.reset();  // its names are those of the first's objects; the first's must survive
  EXPECT_EQ(of_first.run(3), expected(3));
}

TEST(Context, MayEndBeforeWhatWasMadeWithIt) {
  auto context = std::make_unique<Context>();
  auto copier = std::make_unique<Copier>(*context);
  context.reset();
  EXPECT_EQ(copier->run(4), expected(4));
  Context next;
  EXPECT_EQ(Copier(next).run(5), expected(5));
  EXPECT_EQ(copier->run(6), expected(6));
  copier.reset();
  EXPECT_EQ(Copier(next).run(7), expected(7));
}

TEST(Context, EveryThreadMayHaveItsOwn) {
  std::vector<int> result;
  Context here;
  Copier copier(here);
  std::thread([&] {
    Context there;
    result = Copier(there).run(8);
  }).join();
  EXPECT_EQ(result, expected(8));
  EXPECT_EQ(copier.run(9), expected(9));
}

TEST(Program, TellsTheCompilersLog) {
  Context context;
  try {
    const Program program(context,
                          "#version 430 core\nlayout(local_size_x = 1) in;\nvoid main() { no_such_thing(); }");
    FAIL() << "compiled";
  } catch (const base::Failure& failure) {
    EXPECT_EQ(failure.code(), "gl");
    EXPECT_NE(std::string(failure.what()).find("no_such_thing"), std::string::npos) << failure.what();
  }
  EXPECT_EQ(Copier(context).run(10), expected(10));  // the context is none the worse
}

TEST(Program, TellsTheLinkersLog) {
  Context context;
  try {  // a function that is declared, called, and nowhere defined
    const Program program(
        context,
        "#version 430 core\nlayout(local_size_x = 1) in;\nlayout(std430, binding = 0) buffer Out { "
        "int value; };\nint elsewhere();\nvoid main() { value = elsewhere(); }");
    FAIL() << "linked";
  } catch (const base::Failure& failure) {
    EXPECT_EQ(failure.code(), "gl");
    EXPECT_NE(std::string(failure.what()).find("elsewhere"), std::string::npos) << failure.what();
  }
}

TEST(Texture, RefusesMoreSlicesThanGlHas) {
  Context context;
  constexpr int kSlices = 1 << 17;
  const std::vector<std::int16_t> values(kSlices);
  try {
    const Texture texture(context, {1, 1, kSlices}, values);
    FAIL() << "accepted";
  } catch (const base::Failure& failure) {
    EXPECT_EQ(failure.code(), "gl");
  }
}

TEST(Buffer, GivesBackWhatWasWritten) {
  Context context;
  Buffer buffer(context, BufferUse::storage, 8 * sizeof(double));
  const std::vector<double> written{1.0, -2.5, 1e300, 0.0, -0.0, 3.0, 4.0, 5.0};
  buffer.write(std::as_bytes(std::span(written)));
  std::vector<double> read(8);
  buffer.read(std::as_writable_bytes(std::span(read)));
  EXPECT_EQ(read, written);
}

TEST(Context, AFenceIsPassedOnceWhatWasToldBeforeIsDone) {
  Context context;
  Copier copier(context);
  Fence before(context);
  EXPECT_TRUE(before.passed(10.0));
  copier.run(1);
  Fence after(context);
  while (!after.passed(0.001)) {
  }
  EXPECT_TRUE(after.passed(0.0)) << "it stays so";
}

}  // namespace
}  // namespace seldinger::gpu
