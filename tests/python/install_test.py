"""pip installs the package into a fresh virtual environment, from the build that is there."""
import os
import pathlib
import shutil
import subprocess

from conftest import SOURCE

# What pip needs of the clone where CMake has built already; its own folder, so that nothing is left in the clone.
NEEDED = ["pyproject.toml", "setup.py", "CMakeLists.txt", "README.md", "LICENSE", "python"]


def test_pip_installs_it(tmp_path):
    clone = tmp_path / "clone"
    clone.mkdir()
    for name in NEEDED:
        copy = shutil.copytree if (SOURCE / name).is_dir() else shutil.copy
        copy(SOURCE / name, clone / name)
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}

    def run(*command, **more):
        ran = subprocess.run([*map(str, command)], capture_output=True, text=True, cwd=tmp_path, env={**clean, **more})
        assert ran.returncode == 0, ran.stdout + ran.stderr
        return ran.stdout.strip()

    run("/usr/bin/python3", "-m", "venv", "--system-site-packages", tmp_path / "venv")
    python = tmp_path / "venv/bin/python"
    run(python, "-m", "pip", "install", "--no-build-isolation", "--no-index", clone, FROUDE_BUILD=os.environ["FROUDE_BUILD"])
    where = run(python, "-c", "import froude; print(froude.__file__); froude.spectrum('jonswap', hs=1, tp=5)")
    package = pathlib.Path(where).parent
    assert package.is_relative_to(tmp_path / "venv")
    assert (package / "py.typed").exists() and (package / "_froude.pyi").exists()
    said = run(python, "-c", "import froude, importlib.metadata as m; print(froude.__version__ == m.version('froude'))")
    assert said == "True"
