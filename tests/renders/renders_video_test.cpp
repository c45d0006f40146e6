// The film file and the strip made of the frames.
#include "base/output_file.hpp"
#include "renders/video.hpp"

#include <gmock/gmock.h>

#include <cstdlib>

#include "renders/filmstrip.hpp"
#include "renders/png_image.hpp"
#include "renders/process.hpp"
#include "renders/report.hpp"
#include "tests/renders/renders_scratch.hpp"

namespace drycut::renders {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Frames of one colour each, from dark to bright, with a black caption of 20 pixels.
std::vector<std::filesystem::path> frames_in(const std::filesystem::path& folder, int count, int width = 161,
                                             int height = 121) {
  std::filesystem::create_directories(folder);
  std::vector<std::filesystem::path> files;
  for (int i = 0; i < count; ++i) {
    Image image(width, height);
    const auto level = static_cast<std::uint8_t>(60 + 190 * i / count);
    std::fill(image.rgb.begin(), image.rgb.end() - 20 * 3 * width, level);
    files.push_back(folder / ("frame_0000" + std::to_string(i) + ".png"));
    write_file(files.back(), png_bytes(image));
  }
  return files;
}

bool has(const char* program) {
  try {
    return run_process({program, program, {"-version"}}).good;
  } catch (const std::runtime_error&) {
    return false;
  }
}

TEST(Video, HasEveryFrameAtItsPeriod) {
  if (!has("ffmpeg") || !has("ffprobe")) GTEST_SKIP() << "ffmpeg is not installed";
  const Scratch scratch;
  frames_in(scratch / "frames", 7);
  encode_video(scratch / "frames", 40'000'000, 4, scratch / "film.mp4");
  const auto told = run_process({"ffprobe",
                                 "ffmpeg",
                                 {"-v", "error", "-count_frames", "-select_streams", "v:0", "-show_entries",
                                  "stream=codec_name,width,height,r_frame_rate,nb_read_frames", "-of",
                                  "csv=p=0", (scratch / "film.mp4").string()}});
  EXPECT_THAT(told.output, HasSubstr("h264,162,122,25/1,7")) << "odd sizes grow by a pixel";
}

TEST(Video, ItsCoverIsThePosterWithItsOwnBytes) {
  if (!has("ffmpeg")) GTEST_SKIP() << "ffmpeg is not installed";
  const Scratch scratch;
  const auto frames = frames_in(scratch / "frames", 7);
  encode_video(scratch / "frames", 40'000'000, 4, scratch / "film.mp4");
  ASSERT_TRUE(run_process({"ffmpeg",
                           "ffmpeg",
                           {"-v", "error", "-i", (scratch / "film.mp4").string(), "-map", "0:v:1", "-c",
                            "copy", "-f", "image2", "-update", "1", (scratch / "cover.png").string()}})
                  .good);
  EXPECT_EQ(read_file(scratch / "cover.png"), read_file(frames[4]));
}

TEST(Video, InAReportThePosterStandsForItAndItsShapeLeavesTheControlsRoom) {
  const Scratch scratch;
  write_file(scratch / "film.mp4", "what a player would play");
  Report report;
  report.frames = {{frames_in(scratch / "frames", 1).front(), "0.040 s"}};
  report.video = scratch / "film.mp4";
  write_report(report, scratch / "bare.html");
  EXPECT_THAT(read_file(scratch / "bare.html"), Not(HasSubstr("poster=")));
  report.poster = report.frames.front().png;
  write_report(report, scratch / "with.html");
  const auto page = read_file(scratch / "with.html");
  EXPECT_THAT(page, HasSubstr(" style=\"--shape:0.751553\" poster=\"data:image/png;base64,iVBOR"));
  EXPECT_THAT(page, HasSubstr("figure video[style] { height: calc(100cqw * var(--shape)"));
}

TEST(Video, SameFramesSameBytes) {
  if (!has("ffmpeg")) GTEST_SKIP() << "ffmpeg is not installed";
  const Scratch scratch;
  frames_in(scratch / "frames", 5);
  encode_video(scratch / "frames", 2'000'000, 1, scratch / "a.mp4");
  encode_video(scratch / "frames", 2'000'000, 1, scratch / "b.mp4");
  EXPECT_EQ(read_file(scratch / "a.mp4"), read_file(scratch / "b.mp4"));
}

TEST(Video, SaysWhatIsWrongAndLeavesNothingHalf) {
  if (!has("ffmpeg")) GTEST_SKIP() << "ffmpeg is not installed";
  const Scratch scratch;
  std::filesystem::create_directories(scratch / "frames");
  EXPECT_THAT(message_of<std::runtime_error>(
                  [&] { encode_video(scratch / "frames", 40'000'000, 0, scratch / "film.mp4"); }),
              HasSubstr("video: ffmpeg failed: "));
  EXPECT_FALSE(std::filesystem::exists(scratch / "film.mp4"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "film.mp4.part"));
}

TEST(Process, SaysWhichPackageBringsAMissingProgram) {
  EXPECT_EQ(message_of<std::runtime_error>([] {
              run_process({"no-such-program", "a-package", {}});
            }),
            "there is no no-such-program; install a-package");
}

TEST(Process, RunsWithItsArgumentsInItsFolder) {
  const Scratch scratch;
  write_file(scratch / "a file.txt", "in the folder");
  EXPECT_EQ(run_process({"cat", "coreutils", {"a file.txt"}, scratch.path}).output, "in the folder");
  const auto bad = run_process({"cat", "coreutils", {"no such file"}, scratch.path});
  EXPECT_FALSE(bad.good);
  EXPECT_THAT(bad.words, HasSubstr("no such file"));
}

TEST(Filmstrip, ShowsTheFramesSideBySideWithoutTheirCaptions) {
  const Scratch scratch;
  const auto files = frames_in(scratch / "frames", 3, 160, 110);
  std::vector<StripFrame> frames;
  for (const auto& file : files) frames.push_back({file, file.stem().string()});
  draw_filmstrip(frames, 20, scratch / "strip.png");
  const Image strip = read_png(scratch / "strip.png");
  EXPECT_EQ(strip.width, 3 * 320 + 4 * 6);
  EXPECT_EQ(strip.height, 180 + 6 + 30);
  for (int i = 0; i < 3; ++i) {
    const int level = 60 + 190 * i / 3;
    for (const int y : {10, 100, 180}) {
      EXPECT_NEAR(strip.row(y)[3 * (6 + i * 326 + 160)], level, 1) << "frame " << i << ", row " << y;
    }
  }
  int written = 0;
  for (int y = 187; y < strip.height; ++y)
    for (int x = 0; x < strip.width; ++x) written += strip.row(y)[3 * x] < 128 ? 1 : 0;
  EXPECT_GT(written, 100) << "labels below";
}

TEST(Filmstrip, ALongLabelTakesAnotherLineAndLosesNothing) {
  const Scratch scratch;
  const auto files = frames_in(scratch / "frames", 2, 160, 110);
  const auto written = [&](const std::string& label) {
    draw_filmstrip({{files[0], label}, {files[1], "0.08 s"}}, 20, scratch / "strip.png");
    const Image strip = read_png(scratch / "strip.png");
    int dark = 0;
    for (int y = 187; y < strip.height; ++y)
      for (int x = 0; x < strip.width; ++x) dark += strip.row(y)[3 * x] < 128 ? 1 : 0;
    return std::pair(strip.height, dark);
  };
  const std::string words = "what happened in this frame of it";
  const auto once = written(words);
  const auto twice = written(words + " " + words);
  EXPECT_EQ(once.first, 180 + 6 + 30);
  EXPECT_EQ(twice.first, 180 + 6 + 30 + 19);
  const int other = written("").second;  // the label of the second frame
  EXPECT_NEAR(twice.second - other, 2 * (once.second - other), 0.1 * once.second);
}

TEST(Filmstrip, RefusesWhatCannotBeDrawn) {
  const Scratch scratch;
  const auto files = frames_in(scratch / "frames", 1);
  const auto other = frames_in(scratch / "other", 1, 200, 121);
  const auto file = scratch / "strip.png";
  EXPECT_EQ(message_of<std::invalid_argument>([&] { draw_filmstrip({}, 20, file); }), "filmstrip: no frames");
  EXPECT_EQ(message_of<std::invalid_argument>([&] {
              draw_filmstrip({{files[0], ""}}, 121, file);
            }),
            "filmstrip: the caption covers the whole frame");
  EXPECT_THAT(message_of<std::invalid_argument>([&] {
                draw_filmstrip({{files[0], ""}, {other[0], ""}}, 20, file);
              }),
              HasSubstr("is of another size"));
  EXPECT_THAT(message_of<std::runtime_error>([&] {
                draw_filmstrip({{scratch / "none.png", ""}}, 20, file);
              }),
              HasSubstr("none.png"));
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace drycut::renders
