#include "froude/film/video.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "froude/film/grey.hpp"
#include "hydro/base/error.hpp"

namespace froude::film {
namespace {

using fit::camera::Picture;
using hydro::InputError;

/// OpenCV tells of each codec that it tries; what matters is told here.
void be_quiet() { cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT); }

cv::Mat coloured(const Picture& picture) {
  cv::Mat out;
  cv::cvtColor(grey_of(picture), out, cv::COLOR_GRAY2BGR);
  return out;
}

void near_to(const Colour& colour, const cv::Mat& frame, Picture& out) {
  constexpr double farthest = 170;
  for (int y = 0; y < frame.rows; ++y) {
    const auto* from = frame.ptr<cv::Vec3b>(y);
    std::uint8_t* to = out.row(y);
    for (int x = 0; x < frame.cols; ++x) {
      const double blue = from[x][0] - colour[2], green = from[x][1] - colour[1], red = from[x][2] - colour[0],
                   distance = std::sqrt(blue * blue + green * green + red * red);
      to[x] = static_cast<std::uint8_t>(std::lround(255 * std::max(0.0, 1 - distance / farthest)));
    }
  }
}

cv::Scalar scalar(const Colour& colour) { return {double(colour[2]), double(colour[1]), double(colour[0])}; }
constexpr int shift = 4;  // OpenCV draws to 1/16 of a pixel
cv::Point fine(const Eigen::Vector2d& p) {
  return {static_cast<int>(std::lround(p.x() * (1 << shift))), static_cast<int>(std::lround(p.y() * (1 << shift)))};
}

std::string ending(const Path& file) {
  std::string out = file.extension().string();
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::tolower(c); });
  return out;
}

}  // namespace

std::string how_to_convert(const Path& file) {
  return "convert it, for example: ffmpeg -i " + file.filename().string() + " -c:v ffv1 film.avi";
}

struct FilmReader::Video {
  cv::VideoCapture capture;
  cv::Mat frame, grey;
  std::size_t read = 0;
};

FilmReader::FilmReader(const Path& file) : video_(std::make_unique<Video>()) {
  be_quiet();
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown))
    throw InputError("there is no such film", {.file = file.string()}, "name a film: .mp4, .mov, .avi, .mkv");
  if (!video_->capture.open(file.string(), cv::CAP_FFMPEG) || size().x() <= 0 || size().y() <= 0)
    throw InputError("this is no film that OpenCV can decode", {.file = file.string()}, how_to_convert(file));
}

FilmReader::~FilmReader() = default;

Eigen::Vector2i FilmReader::size() const {
  return {static_cast<int>(video_->capture.get(cv::CAP_PROP_FRAME_WIDTH)),
          static_cast<int>(video_->capture.get(cv::CAP_PROP_FRAME_HEIGHT))};
}
double FilmReader::frame_rate() const {
  const double rate = video_->capture.get(cv::CAP_PROP_FPS);
  return std::isfinite(rate) && rate > 0 ? rate : 0;
}
std::size_t FilmReader::frames() const {
  return static_cast<std::size_t>(std::max(0.0, video_->capture.get(cv::CAP_PROP_FRAME_COUNT)));
}

std::string FilmReader::lossy_codec() const {
  constexpr std::array lossy{"avc1", "h264", "x264", "hevc", "hvc1", "hev1", "mp4v", "fmp4", "xvid", "divx", "dx50",
                             "mjpg", "mpg1", "mpg2", "vp80", "vp90", "vp09", "av01", "wmv1", "wmv2", "wmv3", "h263"};
  const auto code = static_cast<std::uint32_t>(video_->capture.get(cv::CAP_PROP_FOURCC));
  std::string name;
  for (unsigned byte = 0; byte < 4; ++byte) name += static_cast<char>((code >> (8 * byte)) & 0xffU);
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(lossy.begin(), lossy.end(), lower) == lossy.end() ? std::string() : name;
}

bool FilmReader::next(Picture& picture, double& time_s, const std::optional<Colour>& colour) {
  Video& v = *video_;
  if (!v.capture.read(v.frame) || v.frame.empty()) return false;
  time_s = v.capture.get(cv::CAP_PROP_POS_MSEC) / 1000;
  ++v.read;
  if (picture.width != v.frame.cols || picture.height != v.frame.rows) picture = Picture(v.frame.cols, v.frame.rows);
  cv::Mat to = grey_of(picture);
  if (v.frame.channels() == 1)
    v.frame.copyTo(to);
  else if (colour)
    near_to(*colour, v.frame, picture);
  else
    cv::cvtColor(v.frame, to, cv::COLOR_BGR2GRAY);
  return true;
}

struct FilmWriter::Video {
  cv::VideoWriter writer;
};

FilmWriter::FilmWriter(const Path& file, const Eigen::Vector2i& size, double frame_rate)
    : video_(std::make_unique<Video>()) {
  be_quiet();
  const std::string kind = ending(file);
  if (kind != ".avi" && kind != ".mkv" && kind != ".mp4")
    throw InputError(fmt::format("a film is not written as \"{}\"", kind), {.file = file.string()},
                     "name it .avi or .mkv (without loss), or .mp4");
  const int codec =
      kind == ".mp4" ? cv::VideoWriter::fourcc('m', 'p', '4', 'v') : cv::VideoWriter::fourcc('F', 'F', 'V', '1');
  if (!video_->writer.open(file.string(), cv::CAP_FFMPEG, codec, frame_rate, cv::Size(size.x(), size.y()), true))
    throw InputError("the film cannot be written", {.file = file.string()},
                     "is the folder there, and may it be written to?");
}
FilmWriter::~FilmWriter() = default;
void FilmWriter::add(const Picture& picture) { video_->writer.write(coloured(picture)); }

struct Annotation::Canvas {
  cv::Mat picture;
};

Annotation::Annotation(const Picture& picture) : canvas_(std::make_unique<Canvas>(Canvas{coloured(picture)})) {}
Annotation::~Annotation() = default;
Annotation::Annotation(Annotation&&) noexcept = default;

void Annotation::circle(const Eigen::Vector2d& centre, double radius, const Colour& colour) {
  cv::circle(canvas_->picture, fine(centre), static_cast<int>(std::lround(radius * (1 << shift))), scalar(colour), 1,
             cv::LINE_AA, shift);
}
void Annotation::cross(const Eigen::Vector2d& centre, double size, const Colour& colour) {
  for (const Eigen::Vector2d& arm : {Eigen::Vector2d(size, 0), Eigen::Vector2d(0, size)})
    cv::line(canvas_->picture, fine(centre - arm), fine(centre + arm), scalar(colour), 1, cv::LINE_AA, shift);
}
void Annotation::path(const std::vector<Eigen::Vector2d>& points, const Colour& colour) {
  for (std::size_t i = 1; i < points.size(); ++i)
    cv::line(canvas_->picture, fine(points[i - 1]), fine(points[i]), scalar(colour), 1, cv::LINE_AA, shift);
}
void Annotation::label(const Eigen::Vector2d& at, const std::string& text, const Colour& colour) {
  cv::putText(canvas_->picture, text, {static_cast<int>(at.x()), static_cast<int>(at.y())}, cv::FONT_HERSHEY_SIMPLEX,
              0.4, scalar(colour), 1, cv::LINE_AA);
}
void Annotation::add_to(FilmWriter& film) const { film.video_->writer.write(canvas_->picture); }
void Annotation::write(const Path& file) const {
  bool done = false;
  try {
    done = cv::imwrite(file.string(), canvas_->picture);
  } catch (const cv::Exception&) {  // an ending that it does not know
  }
  if (!done)
    throw InputError("the picture cannot be written", {.file = file.string()},
                     "name it .png, in a folder that is there");
}

Picture read_picture(const Path& file) {
  be_quiet();
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown))
    throw InputError("there is no such picture", {.file = file.string()}, "name a .png, .jpg or .tif");
  const cv::Mat grey = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
  if (grey.empty())
    throw InputError("this is no picture that OpenCV can read", {.file = file.string()}, "name a .png, .jpg or .tif");
  Picture out(grey.cols, grey.rows);
  cv::Mat to = grey_of(out);
  grey.copyTo(to);
  return out;
}

void write_picture(const Path& file, const Picture& picture) { Annotation(picture).write(file); }

Colour colour_of(std::size_t marker) {
  constexpr std::array<Colour, 8> all{{{230, 25, 75},
                                       {60, 180, 75},
                                       {255, 200, 25},
                                       {67, 130, 255},
                                       {245, 130, 49},
                                       {200, 70, 230},
                                       {70, 230, 230},
                                       {240, 50, 230}}};
  return all[marker % all.size()];
}

}  // namespace froude::film
