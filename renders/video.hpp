#pragma once
#include <cstdint>
#include <filesystem>

namespace drycut::renders {

/// Makes a film file (H.264 in MP4, which browsers, phones and slides play) of `frames`/frame_00000.png ...,
/// a frame every `period_ns`. Encoded by one thread: same frames, same bytes. Throws HelperFailed with
/// the encoder's own words if it fails, or the package to install where there is none.
void encode_video(const std::filesystem::path& frames, std::int64_t period_ns,
                  const std::filesystem::path& file);

}  // namespace drycut::renders
