# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DOUT=page_files.cpp -DFILES=path;type;file;... -P embed.cmake: the files of the page as bytes in a source file.
set(entries "")
while(FILES)
  list(POP_FRONT FILES path type file)
  file(READ ${file} bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" bytes "${bytes}")
  string(REGEX REPLACE "(................................................................................)" "\\1\"\n\"" bytes "${bytes}")
  string(APPEND entries "    {\"${path}\", \"${type}\", std::string(\n\"${bytes}\")},\n")
endwhile()
file(WRITE ${OUT} "// Made of the files of apps/homeward/page.
#include \"page_files.h\"

namespace homeward
{

const std::vector<PageFile> &pageFiles()
{
  static const std::vector<PageFile> files{
${entries}  };
  return files;
}

} // namespace homeward
")
