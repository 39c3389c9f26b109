// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/serve/page_server.h>

#include <vector>

namespace homeward
{

/** The page of Dashboard, as it was bundled into the program; empty where it was not. */
const std::vector<PageFile> &pageFiles();

} // namespace homeward
