// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/pilot/homing_run.h>

#include <homeward/core/error.h>

#include <algorithm>
#include <utility>

namespace homeward
{
namespace
{

/** Home vectors that are averaged. */
constexpr std::size_t kRecent = 4;

Eigen::Vector2d unit(double angle)
{
  return {std::cos(angle), std::sin(angle)};
}

} // namespace

HomingRun::HomingRun(Motion &motion, HomingServo &servo, const HomingRunOptions &options, Look look)
    : m_motion(motion), m_servo(servo), m_options(options), m_look(std::move(look)),
      m_worker(fromSeconds(options.visionLatency)), m_scale(servo.options().landmarkRange),
      m_hereProxy(options.arrivedProxy), m_nearProxy(options.nearProxy)
{}

HomingRun::Result HomingRun::run(std::optional<double> oDeparture, bool exactly,
                                 const std::optional<Eigen::Vector2d> &oPlace)
{
  m_oPlace = oPlace;
  if (oPlace) {
    m_options.retreats = m_options.retreatsOnWay;
    m_options.detours = 0;
    m_options.timeoutSeconds = std::min(m_options.timeoutSeconds, m_options.timeoutOnWay);
  }
  if (oDeparture) {
    m_motion.turnTo(*oDeparture);
  }
  const Time begin = m_motion.devices().clock.now();
  m_nextPicture = begin;
  m_lastSeen = begin;
  m_lastFree = begin;
  m_gotOn = begin;
  m_gotOnAt = m_motion.pose().translation();
  m_startTravelled = m_motion.travelled();
  const auto ends = [this](HomingEnd end) {
    m_motion.stop();
    return Result{end, placeHeading(), false};
  };
  while (true) {
    m_motion.tick();
    perceive();
    const Time now = m_motion.devices().clock.now();
    if (arrived()) {
      return exactly ? comeCloser() : ends(HomingEnd::Arrived);
    }
    if (toSeconds(now - m_lastSeen) > m_options.lostSeconds) {
      return ends(HomingEnd::Lost);
    }
    search();
    noteHeadway();
    if (toSeconds(now - m_lastFree) > m_options.blockedSeconds ||
        toSeconds(now - m_gotOn) > m_options.headwaySeconds) {
      if (beside()) {
        return ends(HomingEnd::Arrived);
      }
      if (!getOut()) {
        return ends(HomingEnd::Blocked);
      }
      m_lastFree = m_motion.devices().clock.now();
      m_lastSeen = m_lastFree;
      m_gotOn = m_lastFree;
    }
    if (toSeconds(now - begin) > m_options.timeoutSeconds) {
      return ends(HomingEnd::TimedOut);
    }
    drive(wayHome(oDeparture));
  }
}

/** Anywhere; where the map says where the place is, towards it. */
void HomingRun::noteHeadway()
{
  const Eigen::Vector2d oHere = m_motion.pose().translation();
  const double headway = m_oPlace ? (m_gotOnAt - *m_oPlace).norm() - (oHere - *m_oPlace).norm()
                                  : (oHere - m_gotOnAt).norm();
  if (headway > m_options.headway) {
    m_gotOnAt = oHere;
    m_gotOn = m_motion.devices().clock.now();
  }
}

HomingRun::Result HomingRun::comeCloser()
{
  settle();
  align();
  for (int step = 0; step < m_options.steps && !settled(); ++step) {
    stepOver();
    align();
  }
  m_motion.stop();
  return {HomingEnd::Arrived, placeHeading(), m_aligned && settled()};
}

void HomingRun::perceive()
{
  const Time now = m_motion.devices().clock.now();
  if (const auto result =
          m_worker.deliver(now, m_options.waitForVision, m_motion.devices().clock)) {
    if (*result && (*result)->confidence >= m_options.minConfidence) {
      take(**result, m_pictureAt);
      m_lastSeen = now;
      m_guesses.clear();
    }
    else if (*result && (*result)->confidence >= m_options.leastGuess) {
      m_guesses.push_back({**result, m_pictureAt});
    }
    else {
      m_guesses.clear(); // a camera that shows next to nothing
    }
  }
  if (!m_worker.busy() && now >= m_nextPicture) {
    const std::optional<Frame> frame = m_motion.devices().camera.grab();
    if (!frame) {
      throw DeviceError("the camera has no more pictures; the robot cannot home without");
    }
    m_pictureAt = m_motion.poseAt(frame->stamp);
    m_nextPicture = now + fromSeconds(m_options.visionPeriod);
    m_worker.request(now, [look = m_look, image = frame->image] { return look(image); });
  }
}

void HomingRun::take(const HomeVector &seen, const Pose2 &oMr)
{
  m_scale.add((oMr * m_servo.mirror()).translation(), oDirection({seen, oMr}), seen.distanceProxy,
              seen.confidence);
  const double metres = m_settling ? m_scale.metres() : m_servo.options().landmarkRange;
  const HomeVector home = m_servo.homeOfRobot(seen, metres);
  m_inside = home.distanceProxy < m_hereProxy ? m_inside + 1 : 0;
  noteReversal(home, oMr);
  m_seen.push_back({home, oMr});
  if (m_seen.size() > kRecent) {
    m_seen.erase(m_seen.begin());
  }
}

double HomingRun::oDirection(const Seen &seen) const
{
  return seen.oMr.heading + m_servo.mirror().heading + seen.home.direction;
}

void HomingRun::noteReversal(const HomeVector &home, const Pose2 &oMr)
{
  constexpr double kSwing = radians(100.0);
  constexpr double kRoom = 0.5; // metres that the robot may move from swing to swing
  if (home.confidence < m_options.swingConfidence) {
    return;
  }
  const Swing now{wrapAngle(oDirection({home, oMr})), oMr.translation()};
  const bool still = m_swing && (m_swing->oPosition - now.oPosition).norm() < kRoom;
  if (!still) {
    m_reversals = 0;
    m_swing = now;
  }
  else if (std::abs(wrapAngle(now.oDirection - m_swing->oDirection)) > kSwing) {
    m_reversals += home.distanceProxy < m_nearProxy ? m_options.reversals : 1;
    m_swing = now;
  }
}

bool HomingRun::arrived() const
{
  return m_inside >= 2 || m_reversals >= m_options.reversals;
}

void HomingRun::settle()
{
  constexpr double kPassed = 2.0; // times settledProxy
  m_settling = true;
  m_hereProxy = m_options.settledProxy;
  m_nearProxy = kPassed * m_options.settledProxy;
  m_inside = 0;
  m_reversals = 0;
  m_swing.reset();
  const Time begin = m_motion.devices().clock.now();
  while (!arrived() &&
         toSeconds(m_motion.devices().clock.now() - begin) < m_options.settleSeconds) {
    drive(wayHome(std::nullopt));
    m_motion.tick();
    perceive();
  }
}

Eigen::Vector2d HomingRun::rest() const
{
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Seen &seen : m_seen) {
    sum += seen.home.distanceProxy * unit(oDirection(seen));
  }
  return m_seen.empty() ? sum : Eigen::Vector2d(sum / static_cast<double>(m_seen.size()));
}

/** By the scale that the way here has told, for a distance proxy may be wrong. */
bool HomingRun::beside() const
{
  return !m_seen.empty() && m_scale.metres() * rest().norm() < m_options.beside;
}

bool HomingRun::settled() const
{
  return !m_aligned || rest().norm() < m_options.settledProxy;
}

void HomingRun::stepOver()
{
  constexpr double kSpeed = 0.1; // m/s
  const Eigen::Vector2d way = m_servo.options().landmarkRange * rest();
  advance(std::atan2(way.y(), way.x()), way.norm(), kSpeed);
}

/** Where single home vectors say nothing, they may all the same point one way, and that way home.
 */
void HomingRun::search()
{
  constexpr std::size_t kGuesses = 6;
  constexpr double kAgreement = 0.9;       // length of the mean of their unit vectors
  constexpr double kMeanConfidence = 0.01; // of guesses that are worth a try
  constexpr double kSpeed = 0.2;           // m/s
  if (m_guesses.size() < kGuesses || m_searches == m_options.searches) {
    return;
  }
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double confidence = 0.0;
  for (const Seen &guess : m_guesses) {
    mean += unit(oDirection(guess)) / static_cast<double>(m_guesses.size());
    confidence += guess.home.confidence / static_cast<double>(m_guesses.size());
  }
  m_guesses.clear();
  if (mean.norm() >= kAgreement && confidence >= kMeanConfidence) {
    ++m_searches;
    advance(std::atan2(mean.y(), mean.x()), m_options.searchStep, kSpeed);
    m_lastSeen = m_motion.devices().clock.now();
  }
}

/** Out of where nothing leads home: back first, then ahead, to see it from elsewhere. */
bool HomingRun::getOut()
{
  if (m_retreats < m_options.retreats) {
    ++m_retreats;
    if (m_motion.retrace(m_options.retreat) || m_motion.backOut(m_options.backOut)) {
      return true;
    }
  }
  return m_detours++ < m_options.detours && goAhead();
}

bool HomingRun::goAhead()
{
  constexpr double kSpeed = 0.15;  // m/s
  constexpr double kSeconds = 6.0; // at most
  constexpr double kLeast = 0.15;  // metres that make it worth while
  const Time begin = m_motion.devices().clock.now();
  const double travelled = m_motion.travelled();
  while (m_motion.travelled() - travelled < m_options.detour &&
         toSeconds(m_motion.devices().clock.now() - begin) < kSeconds &&
         m_motion.follow({kSpeed, 0.0}, 0.0) != LocalDrive::State::Blocked) {
    m_motion.tick();
  }
  m_motion.stop();
  return m_motion.travelled() - travelled > kLeast;
}

/** Straight ahead by odometry, as far as there is room. */
void HomingRun::advance(double oBearing, double metres, double speed)
{
  constexpr double kLeast = 0.01;  // metres left
  constexpr double kSeconds = 5.0; // at most
  const Eigen::Vector2d oTarget = m_motion.pose().translation() + metres * unit(oBearing);
  if (!m_motion.turnTo(oBearing)) {
    return;
  }
  const Time begin = m_motion.devices().clock.now();
  while (unit(oBearing).dot(oTarget - m_motion.pose().translation()) > kLeast &&
         toSeconds(m_motion.devices().clock.now() - begin) < kSeconds) {
    m_motion.follow({speed, 0.0}, 0.0);
    m_motion.tick();
  }
}

void HomingRun::align()
{
  constexpr double kClose = radians(0.5);
  m_motion.turnTo(placeHeading());
  m_seen.clear(); // where it stands now counts
  m_aligned = false;
  const Time begin = m_motion.devices().clock.now();
  while (toSeconds(m_motion.devices().clock.now() - begin) < m_options.alignSeconds) {
    m_motion.tick();
    perceive();
    const double error = m_seen.empty() ? 0.0 : wrapAngle(m_motion.pose().heading - placeHeading());
    if (m_seen.size() == kRecent && std::abs(error) < kClose) {
      m_aligned = true;
      return;
    }
    m_motion.turn(m_servo.align(error).w);
  }
}

double HomingRun::placeHeading() const
{
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Seen &seen : m_seen) {
    sum += seen.home.confidence * unit(seen.oMr.heading - seen.home.headingChange);
  }
  return sum.isZero() ? m_motion.pose().heading : std::atan2(sum.y(), sum.x());
}

Eigen::Vector2d HomingRun::wayHome(std::optional<double> oDeparture) const
{
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double weight = 1.0;
  for (auto seen = m_seen.rbegin(); seen != m_seen.rend(); ++seen) {
    sum += weight * seen->home.confidence * unit(oDirection(*seen));
    weight *= 0.6;
  }
  if (oDeparture) {
    constexpr double kDepartureWeight = 0.5;
    const double driven = m_motion.travelled() - m_startTravelled;
    const double left = std::max(0.0, 1.0 - driven / m_options.departureDistance);
    sum += kDepartureWeight * left * unit(*oDeparture);
  }
  return sum;
}

void HomingRun::drive(const Eigen::Vector2d &oWay)
{
  const Time now = m_motion.devices().clock.now();
  const bool old = toSeconds(now - m_lastSeen) > m_options.commandSeconds;
  if (m_seen.empty() || old || oWay.norm() < 1e-3) {
    m_motion.hold();
    m_lastFree = now; // it does not know the way; nothing bars it
    m_gotOn = now;
    return;
  }
  HomeVector home = m_seen.back().home;
  const double bearing = wrapAngle(std::atan2(oWay.y(), oWay.x()) - m_motion.pose().heading);
  home.direction = wrapAngle(bearing - m_servo.mirror().heading);
  const Twist2 twist = m_servo.approach(home);
  if (m_motion.follow(twist, bearing) != LocalDrive::State::Blocked) {
    m_lastFree = now;
  }
}

} // namespace homeward
