// dsc-vdb-reader FILE [BYTES [GRID]]: a grid of an OpenVDB file to a pipe on standard output
// (image_stream.h), in so much memory.
#include "libdsc/io/vdb/vdb_image.h"

int main(int argc, char** argv) {
  using namespace dsc::detail;
  const ReaderMain reader{
      "dsc-vdb-reader FILE [BYTES [GRID]] reads a grid of OpenVDB for dsc, to a pipe", true,
      open_vdb_image, vdb_message};
  return run_reader(reader, argc, argv);
}
