/// \file
/// \internal
/// OpenMesh's reading and writing, one at a time and without its chatter.
#pragma once

#include <mutex>

namespace dsc::detail {

/// While it lives, OpenMesh's readers and writers, which are singletons with a state, are this
/// thread's, and its streams of messages are silent.
class OpenMeshIo {
 public:
  OpenMeshIo();
  OpenMeshIo(const OpenMeshIo&) = delete;
  OpenMeshIo& operator=(const OpenMeshIo&) = delete;
  ~OpenMeshIo();

 private:
  std::unique_lock<std::mutex> lock_;
  bool log_, err_;
};

}  // namespace dsc::detail
