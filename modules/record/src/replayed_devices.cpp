// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/record/replayed_devices.h>

#include <algorithm>
#include <utility>

namespace homeward
{
namespace
{

/** Answers of one kind: those of the tick in turn, then the last one over and over. */
template <class Value> class Answers
{
public:
  void load(std::vector<Value> values)
  {
    m_values = std::move(values);
    m_next = 0;
  }

  const Value &give()
  {
    if (m_next < m_values.size()) {
      m_last = std::move(m_values[m_next++]);
    }
    return m_last;
  }

private:
  std::vector<Value> m_values;
  std::size_t m_next = 0;
  Value m_last{};
};

/** The tick that is given back, of all devices. */
class Given
{
public:
  Given(std::function<std::optional<Tick>()> next, std::function<void()> askToStop)
      : m_next(std::move(next)), m_askToStop(std::move(askToStop))
  {
    load();
  }

  Answers<char> counted;
  Answers<BaseState> states;
  Answers<std::optional<Scan>> scans;
  Answers<std::optional<Frame>> frames;
  Answers<std::optional<Time>> newest;
  std::optional<Divergence> divergence;
  std::optional<Time> missedPicture;

  void call()
  {
    if (m_stopAfter && m_calls >= *m_stopAfter) {
      m_stopAfter.reset();
      m_askToStop();
    }
    ++m_calls;
  }

  Time time() const { return m_time; }
  bool atEnd() const { return m_last; }

  Time nextInstant()
  {
    if (m_instant < m_instants.size()) {
      m_time = m_instants[m_instant].at;
      if (--m_instants[m_instant].times == 0) {
        ++m_instant;
      }
    }
    return m_time;
  }

  void command(const Twist2 &twist)
  {
    if (m_ended) {
      return; // whoever ends stops the robot
    }
    const bool more = m_command < m_commands.size();
    const std::optional<Twist2> then = more ? std::optional(m_commands[m_command++]) : std::nullopt;
    if (!then || then->v != twist.v || then->w != twist.w) {
      diverge({m_time, then, twist});
    }
  }

  /** A call of a device, which may have failed. */
  void call(Device device)
  {
    call();
    const auto fault = std::find_if(m_faults.begin(), m_faults.end(), [&](const DeviceFault &each) {
      return each.device == device && each.call < m_calls;
    });
    if (fault == m_faults.end()) {
      return;
    }
    const DeviceError error(fault->what);
    m_faults.erase(fault);
    throw error;
  }

  void sleep()
  {
    if (m_command < m_commands.size()) {
      diverge({m_time, m_commands[m_command], std::nullopt});
    }
    load();
  }

private:
  void diverge(const Divergence &what)
  {
    if (!divergence) {
      divergence = what;
    }
  }

  void load()
  {
    std::optional<Tick> tick = m_last ? std::nullopt : m_next();
    if (!tick) {
      m_ended = true;
      throw RecordingEnded("the recording ends here");
    }
    m_instants = std::move(tick->instants);
    m_instant = 0;
    m_time = m_instants.empty() ? m_time : m_instants.front().at;
    counted.load({tick->counted.begin(), tick->counted.end()});
    states.load(std::move(tick->states));
    scans.load(std::move(tick->scans));
    frames.load(std::move(tick->frames));
    newest.load(std::move(tick->newest));
    m_commands = std::move(tick->commands);
    m_command = 0;
    m_faults = std::move(tick->faults);
    m_stopAfter = tick->stopAfter;
    m_calls = 0;
    m_last = tick->last;
  }

  std::function<std::optional<Tick>()> m_next;
  std::function<void()> m_askToStop;
  std::vector<Instant> m_instants;
  std::size_t m_instant = 0;
  Time m_time{};
  std::vector<Twist2> m_commands;
  std::size_t m_command = 0;
  std::vector<DeviceFault> m_faults;
  std::optional<std::size_t> m_stopAfter;
  std::size_t m_calls = 0;
  bool m_last = false;
  bool m_ended = false;
};

class ReplayedClock final : public Clock
{
public:
  explicit ReplayedClock(Given &given) : m_given(given) {}

  Time now() const override
  {
    m_given.call();
    return m_given.nextInstant();
  }

  void sleepUntil(Time /*instant*/) override
  {
    m_given.call();
    m_given.sleep();
  }

  bool counts(bool /*done*/) override
  {
    m_given.call();
    return m_given.counted.give() != 0;
  }

private:
  Given &m_given;
};

class ReplayedBase final : public MobileBase
{
public:
  explicit ReplayedBase(Given &given) : m_given(given) {}

  void drive(const Twist2 &twist) override
  {
    m_given.command(twist);
    m_given.call(Device::Base);
  }

  BaseState state() override
  {
    m_given.call(Device::Base);
    return m_given.states.give();
  }

private:
  Given &m_given;
};

class ReplayedLaser final : public LaserScanner
{
public:
  explicit ReplayedLaser(Given &given) : m_given(given) {}

  std::optional<Scan> scan() override
  {
    m_given.call(Device::Laser);
    return m_given.scans.give();
  }

private:
  Given &m_given;
};

class ReplayedCamera final : public ImageSource
{
public:
  explicit ReplayedCamera(Given &given) : m_given(given) {}

  std::optional<Frame> grab() override
  {
    m_given.call(Device::Camera);
    std::optional<Frame> frame = m_given.frames.give();
    if (!frame || !frame->image.empty()) {
      m_shown = frame ? frame->image : cv::Mat();
      return frame;
    }
    if (!m_given.missedPicture) {
      m_given.missedPicture = m_given.time();
    }
    if (m_shown.empty()) {
      throw DeviceError("the first picture was not recorded");
    }
    frame->image = m_shown;
    return frame;
  }

  std::optional<Time> newest() const override
  {
    m_given.call(Device::Camera);
    return m_given.newest.give();
  }

private:
  Given &m_given;
  cv::Mat m_shown;
};

} // namespace

class ReplayedDevices::Parts
{
public:
  Parts(std::function<std::optional<Tick>()> next, std::function<void()> askToStop)
      : given(std::move(next), std::move(askToStop)), clock(given), base(given), laser(given),
        camera(given)
  {}

  Given given;
  ReplayedClock clock;
  ReplayedBase base;
  ReplayedLaser laser;
  ReplayedCamera camera;
};

ReplayedDevices::ReplayedDevices(std::function<std::optional<Tick>()> next,
                                 std::function<void()> askToStop)
    : m_parts(std::make_unique<Parts>(std::move(next), std::move(askToStop)))
{}

ReplayedDevices::~ReplayedDevices() = default;

Clock &ReplayedDevices::clock()
{
  return m_parts->clock;
}

MobileBase &ReplayedDevices::base()
{
  return m_parts->base;
}

LaserScanner &ReplayedDevices::laser()
{
  return m_parts->laser;
}

ImageSource &ReplayedDevices::camera()
{
  return m_parts->camera;
}

Time ReplayedDevices::now() const
{
  return m_parts->given.time();
}

std::optional<Divergence> ReplayedDevices::divergence() const
{
  return m_parts->given.divergence;
}

std::optional<Time> ReplayedDevices::missedPicture() const
{
  return m_parts->given.missedPicture;
}

bool ReplayedDevices::atEnd() const
{
  return m_parts->given.atEnd();
}

} // namespace homeward
