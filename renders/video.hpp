#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace drycut::renders {

/// Makes a film file (H.264 in MP4, which browsers, phones and slides play) of `frames`/frame_00000.png ...,
/// a frame every `period_ns`. Its cover, which players and folders show for it, is the frame of the
/// number `poster`. Encoded by a fixed number of threads: same frames, same bytes. Throws HelperFailed with
/// the encoder's own words if it fails, or the package to install where there is none.
void encode_video(const std::filesystem::path& frames, std::int64_t period_ns, std::size_t poster,
                  const std::filesystem::path& file);

}  // namespace drycut::renders
