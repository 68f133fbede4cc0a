"""Contact sheets: pictures with their names, as one page and as PNG files that headless Chromium draws of its parts."""
import html
import os
import shutil
import subprocess

COLUMNS, ROWS = 3, 4
CELL_WIDTH, CELL_HEIGHT = 520, 370  # px; a picture of 720 x 480 is shown at seven tenths
STYLE = f"""body {{ margin: 8px; font: 12px sans-serif; background: #888; }}
.sheet {{ display: grid; grid-template-columns: repeat({COLUMNS}, {CELL_WIDTH}px); gap: 8px; margin-bottom: 8px; }}
figure {{ margin: 0; background: #ddd; height: {CELL_HEIGHT}px; display: flex; flex-direction: column; }}
figcaption {{ padding: 3px 6px; }}
img {{ min-height: 0; flex: 1; object-fit: contain; width: 100%; }}"""


def page(root, pictures):
    cells = "\n".join(f'<figure><figcaption>{html.escape(name)}</figcaption><img src="{(root / name).as_uri()}" alt=""></figure>'
                      for name in pictures)
    return f'<!doctype html><meta charset="utf-8"><title>Pictures</title><style>{STYLE}</style>\n<div class="sheet">\n{cells}\n</div>\n'


def write_sheet(root, pictures, folder):
    """Writes index.html with all pictures, and sheet_1.png and so on. Exit status: 1 when a picture cannot be drawn."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "index.html").write_text(page(root, pictures), encoding="utf-8")
    chromium = os.environ.get("CHROMIUM") or shutil.which("chromium")
    size = f"{COLUMNS * (CELL_WIDTH + 8) + 8},{ROWS * (CELL_HEIGHT + 8) + 8}"
    for number, first in enumerate(range(0, len(pictures), COLUMNS * ROWS), 1):
        part, drawn = folder / f"sheet_{number}.html", folder / f"sheet_{number}.png"
        part.write_text(page(root, pictures[first:first + COLUMNS * ROWS]), encoding="utf-8")
        drawn.unlink(missing_ok=True)
        subprocess.run([chromium, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--allow-file-access-from-files",
                        f"--screenshot={drawn.resolve()}", f"--window-size={size}", part.resolve().as_uri()],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        part.unlink()
        if not drawn.exists():
            print(f"{drawn}: Chromium has not drawn it")
            return 1
        print(drawn)
    return 0
