// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sqlite3.h>

#include <csignal>
#include <map>

namespace homeward
{

/**
 * SQLite's way to the disk while it lives, in this process and in those it forks. Nothing is really
 * synced: what was written survives a process, only a power cut would lose it. dieAt() ends the
 * process (SIGKILL) when it is about to write, cut, sync or delete a file for the n-th time.
 */
class KillingVfs
{
public:
  /** What the call does that it is killed at. */
  enum class Last
  {
    Nothing,
    HalfAWrite ///< where it is a write: the first half of its bytes
  };

  KillingVfs()
  {
    realVfs = sqlite3_vfs_find(nullptr);
    vfs = *realVfs;
    vfs.zName = "killing";
    vfs.xOpen = open;
    vfs.xDelete = remove;
    sqlite3_vfs_register(&vfs, 1);
  }
  ~KillingVfs() { sqlite3_vfs_unregister(&vfs); }
  KillingVfs(const KillingVfs &) = delete;
  KillingVfs &operator=(const KillingVfs &) = delete;

  /** @param call number of the call, from now and from 1, that this process does not survive */
  static void dieAt(int call, Last last)
  {
    callsLeft = call;
    lastAct = last;
  }

private:
  static bool isLast() { return --callsLeft == 0; }

  static void die()
  {
    if (isLast()) {
      std::raise(SIGKILL);
    }
  }

  static int open(sqlite3_vfs *, sqlite3_filename name, sqlite3_file *file, int flags,
                  int *outFlags)
  {
    const int code = realVfs->xOpen(realVfs, name, file, flags, outFlags);
    if (file->pMethods == nullptr) {
      return code;
    }
    // Files that are locked and files that are not have methods of their own; these three are
    // alike.
    realFile = file->pMethods;
    sqlite3_io_methods &methods =
        methodsByKind.try_emplace(file->pMethods, *file->pMethods).first->second;
    methods.xWrite = write;
    methods.xTruncate = truncate;
    methods.xSync = sync;
    file->pMethods = &methods;
    return code;
  }

  static int remove(sqlite3_vfs *, const char *name, int syncFolder)
  {
    die();
    return realVfs->xDelete(realVfs, name, syncFolder);
  }

  static int write(sqlite3_file *file, const void *bytes, int size, sqlite3_int64 offset)
  {
    if (isLast()) {
      if (lastAct == Last::HalfAWrite) {
        realFile->xWrite(file, bytes, size / 2, offset);
      }
      std::raise(SIGKILL);
    }
    return realFile->xWrite(file, bytes, size, offset);
  }

  static int truncate(sqlite3_file *file, sqlite3_int64 size)
  {
    die();
    return realFile->xTruncate(file, size);
  }

  static int sync(sqlite3_file *, int)
  {
    die();
    return SQLITE_OK;
  }

  static inline int callsLeft = 0; ///< 0 and below: for ever
  static inline Last lastAct = Last::Nothing;
  static inline sqlite3_vfs *realVfs = nullptr;
  static inline sqlite3_vfs vfs = {};
  static inline const sqlite3_io_methods *realFile = nullptr;
  static inline std::map<const sqlite3_io_methods *, sqlite3_io_methods> methodsByKind;
};

} // namespace homeward
