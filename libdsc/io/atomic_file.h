/// \file
/// A result file that appears whole or not at all.
///
/// Bytes go to a temporary beside the target; commit() flushes it to the disk and renames it over
/// the target. Without a commit the target stays as it was and the temporary is removed. A target
/// that is no regular file (/dev/stdout, a pipe) is written directly, and so is standard output
/// under the name `FORMAT:-` (`ply:-`). A symbolic link is followed; an existing file keeps its
/// permissions and is refused where it is not writable.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dsc {

/// A file under way; commit() makes it the result.
class AtomicFile {
 public:
  /// Opens the temporary. \throws OutputError naming the file and the system's reason.
  explicit AtomicFile(const std::string& path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  /// Removes the temporary where commit() did not succeed.
  ~AtomicFile();

  /// Appends, through a buffer. \throws OutputError (a full disk, a closed pipe).
  void write(const void* data, std::size_t bytes);
  /// The bytes of a text, likewise.
  void write(std::string_view text) { write(text.data(), text.size()); }

  /// Flush, fsync, close, rename; the last is left to a FileGroup of this thread where one lives.
  /// Nothing may be written afterwards. \throws OutputError; the target is then unchanged.
  void commit();

  /// As given.
  const std::string& path() const { return path_; }

  /// Unlinks every live temporary of the process and lets no new one come, for the end of the
  /// process: while one thread removes them, another may be about to open the next. Only calls what
  /// a signal handler may. Nothing can be committed afterwards, no AtomicFile be opened.
  static void remove_all_temporaries() noexcept;

 private:
  void flush();
  void write_through(const char* data, std::size_t bytes);
  [[noreturn]] void fail(const char* action, int error) const;
  void discard() noexcept;

  std::string path_;       ///< as the caller gave it, for messages
  std::string target_;     ///< absolute, links resolved
  std::string temporary_;  ///< empty where the target is written directly
  int slot_ = -1;          ///< in the registry of live temporaries
  int file_ = -1;
  std::vector<char> buffer_;
};

/// The files of one run, which appear together: while a group lives, what its thread commits is on
/// the disk but not under its name, which publish() gives to all at once. What is written directly
/// (a pipe, /dev/stdout) is not held back.
class FileGroup {
 public:
  /// The group of this thread from now on; an earlier one is so again when this one ends.
  FileGroup();
  FileGroup(const FileGroup&) = delete;
  FileGroup& operator=(const FileGroup&) = delete;
  /// Removes what was committed and not published; the targets stay as they were.
  ~FileGroup();

  /// Renames all that was committed. \throws OutputError naming the first that could not be, after
  /// the others were.
  void publish();

 private:
  friend class AtomicFile;
  struct Committed {
    std::string path, target, temporary;
    int slot;
  };
  std::vector<Committed> files_;
  FileGroup* outer_;
};

/// Refuses, before any work is done, a path that an AtomicFile could not write to as things stand.
/// It creates nothing. \throws OutputError naming the file and the remedy.
void check_writable(const std::string& path);

}  // namespace dsc
