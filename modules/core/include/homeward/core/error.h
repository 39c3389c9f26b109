// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace homeward
{

/** The caller broke a rule that the documentation states. */
class LogicError : public std::logic_error
{
public:
  using std::logic_error::logic_error;
};

/** The world did not co-operate. The message names the value, the file and what to do. */
class RuntimeError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/** A file of settings, a description or an argument is missing, unreadable or wrong. */
class ConfigError : public RuntimeError
{
public:
  using RuntimeError::RuntimeError;
};

/** A sensor or motor is absent, silent or talks nonsense. */
class DeviceError : public RuntimeError
{
public:
  using RuntimeError::RuntimeError;
};

/** A map or log could not be read or written. */
class StoreError : public RuntimeError
{
public:
  using RuntimeError::RuntimeError;
};

} // namespace homeward
