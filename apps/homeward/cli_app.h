// SPDX-License-Identifier: GPL-3.0-or-later
// For headers that name CLI11's App only: the library itself takes seconds to compile.
#pragma once

namespace CLI // NOLINT(readability-identifier-naming)
{
class App;
}
