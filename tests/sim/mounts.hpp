#pragma once
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>

namespace drycut::sim {

/// A child process whose mounts are its own: what it mounts is gone with it. Root has that right, everybody
/// else only where the kernel allows namespaces of users.
class Mounts {
 public:
  /// The folder can only be read.
  [[nodiscard]] static bool read_only(const std::filesystem::path& folder) {
    constexpr unsigned long same = MS_BIND | MS_REMOUNT | MS_RDONLY | MS_NOSUID | MS_NODEV;
    return mount(folder.c_str(), folder.c_str(), nullptr, MS_BIND, nullptr) == 0 &&
           mount(nullptr, folder.c_str(), nullptr, same, nullptr) == 0;
  }
  /// The folder is a disk of its own with so much room, as mount writes it: "1500k".
  [[nodiscard]] static bool disk(const std::filesystem::path& folder, const std::string& size) {
    return mount("none", folder.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
  }

  /// What `work` returns in such a child, 0 to 99; nothing where this machine does not allow it. It has
  /// `ready` say whether what it mounted could be.
  static std::optional<int> in_child(const std::function<int(const std::function<void(bool)>& ready)>& work) {
    constexpr int not_allowed = 111;
    const auto user = getuid();
    const auto group = getgid();
    const pid_t child = fork();
    if (child == 0) {
      const bool apart = unshare(CLONE_NEWNS) == 0 || as_its_own_root(user, group);
      if (!apart || mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) _exit(not_allowed);
      const int status = work([](bool mounted) {
        if (!mounted) _exit(not_allowed);
      });
      _exit(status);
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (!WIFEXITED(status)) return 100;
    if (WEXITSTATUS(status) == not_allowed) return {};
    return WEXITSTATUS(status);
  }

 private:
  static bool as_its_own_root(uid_t user, gid_t group) {
    if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
    std::ofstream("/proc/self/setgroups") << "deny";
    std::ofstream("/proc/self/uid_map") << "0 " << user << " 1";
    std::ofstream("/proc/self/gid_map") << "0 " << group << " 1";
    return getuid() == 0;
  }
};

}  // namespace drycut::sim
