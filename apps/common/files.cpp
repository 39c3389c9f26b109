// SPDX-License-Identifier: GPL-3.0-or-later
#include "files.h"

#include <homeward/core/error.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace homeward
{
namespace fs = std::filesystem;

namespace
{

std::FILE *keptOutput = nullptr; ///< where standard output went at first

}

void keepStandardOutputForFiles()
{
  if (keptOutput == nullptr) {
    keptOutput = ::fdopen(::dup(STDOUT_FILENO), "w");
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
  }
}

fs::path shippedFile(const std::string &name)
{
  if (const char *folder = std::getenv("HOMEWARD_DATA")) {
    return fs::path(folder) / name;
  }
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path installed = program.parent_path().parent_path() / "share/homeward" / name;
  return fs::exists(installed, ignored) ? installed : fs::path(HOMEWARD_SOURCE_DATA) / name;
}

std::string readText(const fs::path &file, const std::string &what)
{
  std::error_code ignored;
  std::ifstream stream(file, std::ios::binary);
  if (!stream || fs::is_directory(file, ignored)) {
    throw ConfigError("cannot read the " + what + " " + file.string() +
                      "; check the name and its permissions");
  }
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void writeText(const std::string &file, const std::string &text)
{
  if (file == "-") {
    std::FILE *out = keptOutput != nullptr ? keptOutput : stdout;
    if (std::fwrite(text.data(), 1, text.size(), out) != text.size() || std::fflush(out) != 0) {
      throw RuntimeError("cannot write to standard output");
    }
    return;
  }
  std::error_code error;
  const fs::file_status target = fs::status(file, error);
  const bool device = fs::exists(target) && !fs::is_regular_file(target);
  const fs::path part = device ? file : file + ".part";
  std::ofstream stream(part, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) {
    if (!device) {
      fs::remove(part, error);
    }
    throw RuntimeError("cannot write " + file + "; check that the folder exists and has room");
  }
  if (device) {
    return;
  }
  fs::rename(part, file, error);
  if (error) {
    throw RuntimeError("cannot write " + file + ": " + error.message());
  }
}

cv::Mat readPicture(const std::string &file)
{
  cv::Mat picture = cv::imread(file, cv::IMREAD_ANYCOLOR);
  if (picture.empty()) {
    throw ConfigError("cannot read the picture " + file +
                      "; is it a PNG, JPEG or other image file?");
  }
  return picture;
}

std::string encodePicture(const std::string &file, const cv::Mat &picture)
{
  const std::string kind = file == "-" ? ".png" : std::filesystem::path(file).extension().string();
  bool known = !kind.empty();
  try {
    known = known && cv::haveImageWriter("picture" + kind);
  }
  catch (const cv::Exception &) {
    known = false;
  }
  if (!known) {
    throw ConfigError("cannot write pictures such as " + file + "; name it .png or .jpg");
  }
  std::vector<uchar> bytes;
  cv::imencode(kind, picture, bytes);
  return {bytes.begin(), bytes.end()};
}

std::string encodePng(const cv::Mat &picture)
{
  std::vector<unsigned char> bytes;
  cv::imencode(".png", picture, bytes);
  return {bytes.begin(), bytes.end()};
}

nlohmann::json jsonHeader(const std::string &command)
{
  return {{"schema", 1}, {"version", HOMEWARD_VERSION}, {"command", command}};
}

void writeJson(const std::string &file, const nlohmann::json &json)
{
  if (!file.empty()) {
    writeText(file, json.dump(2) + "\n");
  }
}

} // namespace homeward
