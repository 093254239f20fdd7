"""Builds froude._froude by CMake, for pip; pyproject.toml says the rest.

The environment variable FROUDE_BUILD names a build folder of CMake to use, `build/release` for example; without it one is
made. CMAKE_ARGS has further options for CMake, as other packages take them.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).resolve().parent
# What the package does not need.
LEFT_OUT = ("FROUDE_BUILD_TESTS", "FROUDE_CAMERA", "FROUDE_MPI", "FROUDE_VALIDATION_CASES")


def version():
    """That of the project in CMakeLists.txt."""
    return re.search(r"project\(Froude VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text()).group(1)


def configure(folder):
    """Makes a build folder for this interpreter."""
    cmake = ["cmake", "-S", str(SOURCE), "-B", str(folder), "-DCMAKE_BUILD_TYPE=Release",
             "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG", f"-DPython_EXECUTABLE={sys.executable}", "-DFROUDE_PYTHON=ON"]
    cmake += [f"-D{option}=OFF" for option in LEFT_OUT]
    if shutil.which("ninja"):
        cmake += ["-G", "Ninja"]
    subprocess.run(cmake + shlex.split(os.environ.get("CMAKE_ARGS", "")), check=True)


class CMakeBuild(build_ext):
    """Copies what CMake has built to where setuptools looks for it."""

    def build_extension(self, extension):
        given = os.environ.get("FROUDE_BUILD")
        folder = pathlib.Path(given or self.build_temp).resolve()
        if given and not (folder / "CMakeCache.txt").exists():
            sys.exit(f"error: FROUDE_BUILD: \"{given}\" is no build folder of CMake; configure it, or leave it out")
        if not given:
            configure(folder)
        subprocess.run(["cmake", "--build", str(folder), "--target", "froude_python", "--parallel"], check=True)
        name = "_froude" + sysconfig.get_config_var("EXT_SUFFIX")
        built = folder / "python" / "froude" / name
        if not built.exists():
            sys.exit(f"error: {folder} builds the package for another interpreter: there is no {name}; "
                     f"configure it with -DPython_EXECUTABLE={sys.executable}")
        to = pathlib.Path(self.get_ext_fullpath(extension.name))
        to.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(built, to)


(SOURCE / "build").mkdir(exist_ok=True)  # where nothing of it is under version control
setup(version=version(), ext_modules=[Extension("froude._froude", sources=[])], cmdclass={"build_ext": CMakeBuild},
      options={"egg_info": {"egg_base": "build"}})
