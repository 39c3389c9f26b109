// SPDX-License-Identifier: GPL-3.0-or-later
// Nothing: the program that the tests' precompiled headers belong to.
