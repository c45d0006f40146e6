#include "renders/video.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>

#include "renders/process.hpp"

namespace drycut::renders {
namespace {

/// x264's bytes depend on the number of threads: a fixed one, whatever the machine has.
constexpr auto* threads = "2";

}  // namespace

void encode_video(const std::filesystem::path& frames, std::int64_t period_ns, std::size_t poster,
                  const std::filesystem::path& file) {
  std::filesystem::path unfinished = std::filesystem::absolute(file);
  unfinished += ".part";
  const ProcessCommand command = {"ffmpeg",
                                  "ffmpeg",
                                  {"-v",
                                   "error",
                                   "-nostdin",
                                   "-y",
                                   "-threads",
                                   threads,
                                   "-framerate",
                                   fmt::format("1000000000/{}", period_ns),
                                   "-i",
                                   "frame_%05d.png",
                                   "-i",
                                   fmt::format("frame_{:05}.png", poster),
                                   "-map",
                                   "0:v",
                                   "-map",
                                   "1:v",
                                   "-filter:v:0",
                                   "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                   "-c:v:0",
                                   "libx264",
                                   "-preset",
                                   "veryfast",
                                   "-crf",
                                   "20",
                                   "-pix_fmt:v:0",
                                   "yuv420p",
                                   "-c:v:1",
                                   "copy",
                                   "-disposition:v:1",
                                   "attached_pic",
                                   "-threads",
                                   threads,
                                   "-map_metadata",
                                   "-1",
                                   "-fflags",
                                   "+bitexact",
                                   "-flags:v",
                                   "+bitexact",
                                   "-movflags",
                                   "+faststart",
                                   "-f",
                                   "mp4",
                                   "file:" + unfinished.string()},
                                  frames};
  const auto discard = [&] {
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
  };
  const Finished finished = [&] {
    try {
      return run_process(command);
    } catch (const HelperFailed& error) {
      throw HelperFailed(std::string("video: ") + error.what());
    }
  }();
  if (!finished.good) {
    discard();
    throw HelperFailed("video: ffmpeg failed: " + finished.words);
  }
  std::filesystem::rename(unfinished, file);
}

}  // namespace drycut::renders
