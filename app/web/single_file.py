"""The page as one file, which opens without a web server: single_file.py FOLDER OUT

FOLDER has index.html, index.js and index.wasm.
"""

import base64
import pathlib
import re
import sys

folder, out = map(pathlib.Path, sys.argv[1:])
program = base64.b64encode((folder / "index.wasm").read_bytes()).decode()
script = (f"<script>Module.wasmBinary = Uint8Array.from(atob('{program}'), c => c.charCodeAt(0));</script>\n"
          f"<script>{(folder / 'index.js').read_text()}</script>")
page, found = re.subn(r"<script[^>]*src=.?index\.js.*?</script>", lambda _: script,
                      (folder / "index.html").read_text())
assert found == 1, "index.html has no script index.js"
out.write_text(page)
