#!/bin/sh
# compile_header.sh LAUNCHER COMPILER ARGUMENT…: makes a precompiled header anew, without the one that was there.
# ccache looks at what the preprocessor says, and that reads an old precompiled header in place of the text: what it then
# keeps is found again by other folders of the build whose text differs.
for word; do
  case $word in *.gch) rm -f "$word" ;; esac
done
exec "$@"
