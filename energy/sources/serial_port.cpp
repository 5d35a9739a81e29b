#include "energy/sources/serial_port.h"

#include "energy/sources/discovery.h"
#include "energy/sources/sensor_root.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <grp.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>

namespace encore::energy {

namespace {

struct Speed {
  unsigned baud;
  speed_t code;
};
constexpr std::array<Speed, 10> kSpeeds{{{1200, B1200},
                                         {2400, B2400},
                                         {4800, B4800},
                                         {9600, B9600},
                                         {19200, B19200},
                                         {38400, B38400},
                                         {57600, B57600},
                                         {115200, B115200},
                                         {230400, B230400},
                                         {460800, B460800}}};

speed_t speed_code(const std::string& device, unsigned baud) {
  for (const Speed& speed : kSpeeds) {
    if (speed.baud == baud) return speed.code;
  }
  throw SensorError(fmt::format(
      "{}: {} baud is no usual speed; take 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, "
      "230400 or 460800",
      device, baud));
}

/// The group that may use a device; "dialout" where that cannot be told.
std::string group_of(const std::string& device) {
  struct stat facts {};
  if (::stat(device.c_str(), &facts) != 0 || facts.st_gid == 0) return "dialout";
  const struct group* entry = ::getgrgid(facts.st_gid);
  return entry != nullptr ? entry->gr_name : "dialout";
}

std::string way_out(const std::string& device, int error) {
  switch (error) {
    case ENOENT:
    case ENXIO:
    case ENODEV:
      return "; is the meter plugged in and on? A Bluetooth meter is bound first: sudo rfcomm bind "
             "0 ADDRESS";
    case EACCES:
    case EPERM:
      return fmt::format("; sudo usermod -aG {} $USER, then log in again", group_of(device));
    case EHOSTDOWN:
    case EHOSTUNREACH:
    case ECONNREFUSED:
      return "; the Bluetooth meter does not answer: switch it on, and let nothing else use it";
    default:
      return "";
  }
}

[[noreturn]] void refuse(const std::string& device, int error) {
  throw SensorError(
      fmt::format("{}: {}{}", device, describe_error(device, error), way_out(device, error)));
}

/// No echo, no line editing, no translation.
void make_raw(int file, speed_t speed, const std::string& device) {
  termios settings{};
  if (::tcgetattr(file, &settings) != 0) {
    throw SensorError(
        fmt::format("{}: not a serial port; name the meter's terminal device, such as "
                    "/dev/ttyUSB0 or /dev/rfcomm0",
                    device));
  }
  ::cfmakeraw(&settings);
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | PARENB | CRTSCTS);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cc[VMIN] = 0;
  settings.c_cc[VTIME] = 0;
  ::cfsetispeed(&settings, speed);
  ::cfsetospeed(&settings, speed);
  if (::tcsetattr(file, TCSANOW, &settings) != 0) refuse(device, errno);
}

}  // namespace

SerialPort::SerialPort(const std::string& device, unsigned baud) : device_(device) {
  const speed_t speed = speed_code(device, baud);
  file_ = ::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (file_ < 0) refuse(device, errno);
  try {
    make_raw(file_, speed, device);
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      throw SensorError(device + ": in use by another program; end that first");
    }
  } catch (...) {
    ::close(file_);
    throw;
  }
  drain();
}

SerialPort::~SerialPort() {
  ::close(file_);
}

SerialPort::Received SerialPort::receive() {
  Received received;
  std::array<std::uint8_t, 1024> buffer{};
  // A line cannot bring more between two polls than this; one that does is not a meter.
  constexpr std::size_t kMost = std::size_t{64} * 1024;
  while (received.bytes.size() < kMost) {
    const ssize_t got = ::read(file_, buffer.data(), buffer.size());
    if (got > 0) {
      received.bytes.insert(received.bytes.end(), buffer.begin(), buffer.begin() + got);
      continue;
    }
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && errno != EAGAIN && errno != EWOULDBLOCK) received.gone = true;
    break;
  }
  // An unplugged device reads as empty; only poll tells that from a silent one.
  pollfd state{file_, POLLIN, 0};
  if (received.bytes.empty() && ::poll(&state, 1, 0) > 0 &&
      (state.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0) {
    received.gone = true;
  }
  return received;
}

SerialPort::Received SerialPort::wait(Seconds timeout) {
  pollfd state{file_, POLLIN, 0};
  const int limit = static_cast<int>(std::ceil(std::max(0.0, milliseconds(timeout))));
  if (::poll(&state, 1, limit) <= 0) return {};
  return receive();
}

bool SerialPort::send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::write(file_, bytes.data(), bytes.size());
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

void SerialPort::drain() {
  ::tcflush(file_, TCIFLUSH);
}

std::string printable(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    if (byte >= 0x20 && byte < 0x7f) {
      text += static_cast<char>(byte);
    } else {
      text += fmt::format("\\x{:02x}", byte);
    }
  }
  return text;
}

}  // namespace encore::energy
