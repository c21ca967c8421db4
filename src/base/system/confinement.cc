// SPDX-License-Identifier: GPL-3.0-only
#include "base/system/confinement.h"

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace sprag
{
  namespace
  {
#if defined(__x86_64__)
    constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
    constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#else
    constexpr std::uint32_t architecture = 0; // no filter is made
#endif

    constexpr std::uint32_t refused = SECCOMP_RET_ERRNO | EACCES;

    /// System calls that a mesh needs for nothing, all those that change files among them.
    constexpr int refused_calls[] = {
      // They reach other programs and processes.
      __NR_execve, __NR_execveat, __NR_ptrace, __NR_process_vm_readv, __NR_process_vm_writev, __NR_kill, __NR_tkill,
      // They reach other machines.
      __NR_socket, __NR_socketpair, __NR_connect, __NR_bind,
      // They change files and folders.
      __NR_mkdirat, __NR_mknodat, __NR_unlinkat, __NR_symlinkat, __NR_linkat, __NR_renameat, __NR_renameat2, __NR_truncate,
      __NR_fchmod, __NR_fchmodat, __NR_fchown, __NR_fchownat, __NR_utimensat, __NR_setxattr, __NR_lsetxattr, __NR_fsetxattr,
      __NR_removexattr, __NR_lremovexattr, __NR_fremovexattr,
      // They change what the system shows to a process.
      __NR_mount, __NR_umount2, __NR_pivot_root, __NR_chroot, __NR_setns, __NR_unshare,
      // They share keys, memory or messages with other processes.
      __NR_keyctl, __NR_add_key, __NR_request_key, __NR_shmget, __NR_msgget, __NR_semget, __NR_mq_open,
      // They go past the checks of opening a file.
      __NR_open_by_handle_at, __NR_bpf, __NR_io_uring_setup, __NR_openat2,
#ifdef __x86_64__
      // Older names of those that change files.
      __NR_creat, __NR_mkdir, __NR_rmdir, __NR_mknod, __NR_unlink, __NR_symlink, __NR_link, __NR_rename, __NR_chmod, __NR_chown,
      __NR_lchown, __NR_utime, __NR_utimes, __NR_futimesat
#endif
    };

    void load(const std::size_t place, std::vector<sock_filter> &filter)
    {
      filter.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(place)));
    }

    void give(const std::uint32_t answer, std::vector<sock_filter> &filter)
    {
      filter.push_back(BPF_STMT(BPF_RET | BPF_K, answer));
    }

    /// Opening is refused with flags that write; the number of the call is loaded before and after.
    void refuse_to_write(const int call, const unsigned int argument, std::vector<sock_filter> &filter)
    {
      constexpr std::uint32_t writes = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;
      filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 4));
      load(offsetof(seccomp_data, args) + argument * sizeof(std::uint64_t), filter); // the lower half
      filter.push_back(BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, writes, 0, 1));
      give(refused, filter);
      give(SECCOMP_RET_ALLOW, filter);
    }

    bool filter_calls()
    {
      if (architecture == 0)
        return false;
      std::vector<sock_filter> filter;
      load(offsetof(seccomp_data, arch), filter);
      filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0));
      give(refused, filter);
      load(offsetof(seccomp_data, nr), filter);
#ifdef __x86_64__
      // Numbers of the x32 interface name the same calls again.
      filter.push_back(BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, 0x40000000, 0, 1));
      give(refused, filter);
      refuse_to_write(__NR_open, 1, filter);
#endif
      refuse_to_write(__NR_openat, 2, filter);
      for (const int call : refused_calls)
      {
        filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 1));
        give(refused, filter);
      }
      give(SECCOMP_RET_ALLOW, filter);
      const sock_fprog program = { static_cast<unsigned short>(filter.size()), filter.data() };
      return ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
    }

    /// All rights to files that the kernel's version of Landlock can take: the version, 1 on, added one after another.
    std::uint64_t access_rights(const long version)
    {
      constexpr std::array<unsigned int, 3> number = { { 13, 14, 15 } };
      const auto last                              = static_cast<std::size_t>(version) - 1;
      return (std::uint64_t(1) << number[last < number.size() ? last : number.size() - 1]) - 1;
    }

    bool close_files(const std::vector<std::string> &readable)
    {
      const long version = ::syscall(__NR_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
      if (version < 1)
        return false;
      landlock_ruleset_attr all = {};
      all.handled_access_fs     = access_rights(version);
      const int rules           = static_cast<int>(::syscall(__NR_landlock_create_ruleset, &all, sizeof all, 0));
      if (rules < 0)
        return false;
      for (const auto &path : readable)
      {
        struct stat status              = {};
        landlock_path_beneath_attr rule = {};
        rule.parent_fd                  = ::open(path.c_str(), O_PATH | O_CLOEXEC);
        rule.allowed_access             = LANDLOCK_ACCESS_FS_READ_FILE;
        if (::fstat(rule.parent_fd, &status) == 0 && S_ISDIR(status.st_mode))
          rule.allowed_access |= LANDLOCK_ACCESS_FS_READ_DIR;
        ::syscall(__NR_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
        ::close(rule.parent_fd);
      }
      const bool closed = ::syscall(__NR_landlock_restrict_self, rules, 0) == 0;
      ::close(rules);
      return closed;
    }
  } // namespace

  bool confine(const std::vector<std::string> &readable)
  {
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
      return false;
    const bool closed   = close_files(readable);
    const bool filtered = filter_calls();
    return closed && filtered;
  }
} // namespace sprag
