// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/record/recording_devices.h>

#include <homeward/core/error.h>

#include <cstring>
#include <utility>

namespace homeward
{
namespace
{

/** The tick under way, of all devices. */
struct Under
{
  const std::atomic<bool> &stop;
  RecordingDevices::Keep keep;
  Tick tick = {};
  std::size_t calls = 0; ///< of the tick
  bool stopped = false;  ///< the stop was seen
  bool finished = false;

  void call()
  {
    if (!stopped && stop) {
      stopped = true;
      tick.stopAfter = calls;
    }
    ++calls;
  }

  void end(bool last)
  {
    tick.last = last;
    if (!finished) {
      keep(std::exchange(tick, {}));
    }
    tick = {};
    calls = 0;
    finished = finished || last;
  }

  /** The answer of a device, or what is thrown instead. */
  template <class Ask> auto ask(Device device, Ask what)
  {
    call();
    try {
      return what();
    }
    catch (const DeviceError &error) {
      tick.faults.push_back({device, calls - 1, error.what()});
      throw;
    }
  }
};

class RecordingClock final : public Clock
{
public:
  RecordingClock(Clock &clock, Under &under) : m_clock(clock), m_under(under) {}

  Time now() const override
  {
    m_under.call();
    const Time now = m_clock.now();
    std::vector<Instant> &instants = m_under.tick.instants;
    if (!instants.empty() && instants.back().at == now) {
      ++instants.back().times;
    }
    else {
      instants.push_back({now});
    }
    return now;
  }

  void sleepUntil(Time instant) override
  {
    m_under.call();
    m_under.end(false);
    m_clock.sleepUntil(instant);
  }

  bool counts(bool done) override
  {
    m_under.call();
    m_under.tick.counted.push_back(m_clock.counts(done));
    return m_under.tick.counted.back();
  }

private:
  Clock &m_clock;
  Under &m_under;
};

class RecordingBase final : public MobileBase
{
public:
  RecordingBase(MobileBase &base, Under &under) : m_base(base), m_under(under) {}

  void drive(const Twist2 &twist) override
  {
    m_under.tick.commands.push_back(twist);
    m_under.ask(Device::Base, [&] { m_base.drive(twist); });
  }

  BaseState state() override
  {
    m_under.tick.states.push_back(m_under.ask(Device::Base, [&] { return m_base.state(); }));
    return m_under.tick.states.back();
  }

private:
  MobileBase &m_base;
  Under &m_under;
};

class RecordingLaser final : public LaserScanner
{
public:
  RecordingLaser(LaserScanner &laser, Under &under) : m_laser(laser), m_under(under) {}

  std::optional<Scan> scan() override
  {
    m_under.tick.scans.push_back(m_under.ask(Device::Laser, [&] { return m_laser.scan(); }));
    return m_under.tick.scans.back();
  }

private:
  LaserScanner &m_laser;
  Under &m_under;
};

bool samePicture(const cv::Mat &a, const cv::Mat &b)
{
  if (a.size() != b.size() || a.type() != b.type()) {
    return false;
  }
  const std::size_t bytes = static_cast<std::size_t>(a.cols) * a.elemSize();
  for (int row = 0; row < a.rows; ++row) {
    if (std::memcmp(a.ptr(row), b.ptr(row), bytes) != 0) {
      return false;
    }
  }
  return true;
}

class RecordingCamera final : public ImageSource
{
public:
  RecordingCamera(ImageSource &camera, Under &under) : m_camera(camera), m_under(under) {}

  std::optional<Frame> grab() override
  {
    std::optional<Frame> frame = m_under.ask(Device::Camera, [&] { return m_camera.grab(); });
    if (frame && !(m_last.stamp == frame->stamp && samePicture(m_last.image, frame->image))) {
      // The device may write its next picture where this one is.
      m_last = {frame->stamp, frame->image.clone()};
    }
    m_under.tick.frames.push_back(frame ? std::optional(m_last) : std::nullopt);
    return frame;
  }

  std::optional<Time> newest() const override
  {
    m_under.tick.newest.push_back(m_under.ask(Device::Camera, [&] { return m_camera.newest(); }));
    return m_under.tick.newest.back();
  }

private:
  ImageSource &m_camera;
  Under &m_under;
  Frame m_last;
};

} // namespace

class RecordingDevices::Parts
{
public:
  Parts(Clock &realClock, MobileBase &realBase, LaserScanner &realLaser, ImageSource &realCamera,
        const std::atomic<bool> &stop, Keep keep)
      : under{stop, std::move(keep)}, clock(realClock, under), base(realBase, under),
        laser(realLaser, under), camera(realCamera, under)
  {}

  Under under;
  RecordingClock clock;
  RecordingBase base;
  RecordingLaser laser;
  RecordingCamera camera;
};

RecordingDevices::RecordingDevices(Clock &clock, MobileBase &base, LaserScanner &laser,
                                   ImageSource &camera, const std::atomic<bool> &stop, Keep keep)
    : m_parts(std::make_unique<Parts>(clock, base, laser, camera, stop, std::move(keep)))
{}

RecordingDevices::~RecordingDevices() = default;

Clock &RecordingDevices::clock()
{
  return m_parts->clock;
}

MobileBase &RecordingDevices::base()
{
  return m_parts->base;
}

LaserScanner &RecordingDevices::laser()
{
  return m_parts->laser;
}

ImageSource &RecordingDevices::camera()
{
  return m_parts->camera;
}

void RecordingDevices::note(std::string json)
{
  m_parts->under.tick.notes.push_back(std::move(json));
}

void RecordingDevices::finish()
{
  m_parts->under.end(true);
}

} // namespace homeward
