// dsc-image-reader IMAGE [BYTES]: a medical image, by ITK, to a pipe on standard output
// (image_stream.h), in so much memory.
#include "libdsc/io/itk/image.h"

#include <itkMacro.h>
#include <itkObject.h>

#include <exception>
#include <memory>
#include <string>

namespace dsc::detail {
namespace {

/// ITK allocates what a header asks for, so that is asked first.
std::unique_ptr<Image> open_checked(const ImageRequest& request) {
  std::unique_ptr<Image> image = open_image(request.path);
  (void)value_bytes(image->header());
  return image;
}

std::string message_of(const std::exception& error) {
  const auto* of_itk = dynamic_cast<const itk::ExceptionObject*>(&error);
  if (of_itk == nullptr) return error.what();
  const std::string text = of_itk->GetDescription();  // itk::ERROR: Class(0x55…): what
  const std::size_t place = text.find("): ");
  return place == std::string::npos ? text : text.substr(place + 3);
}

}  // namespace
}  // namespace dsc::detail

int main(int argc, char** argv) {
  using namespace dsc::detail;
  itk::Object::GlobalWarningDisplayOff();
  const ReaderMain reader{"dsc-image-reader IMAGE [BYTES] reads an image for dsc, to a pipe", false,
                          open_checked, message_of};
  return run_reader(reader, argc, argv);
}
