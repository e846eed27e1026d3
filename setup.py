"""Builds the Python module by CMake, in build/python, for the interpreter that runs this."""

import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

project = pathlib.Path(__file__).resolve().parent
scratch = project / "build" / "python"
version = re.search(r"project\(\S+ VERSION (\S+)", (project / "CMakeLists.txt").read_text()).group(1)


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        subprocess.run(
            ["cmake", "-S", project, "-B", scratch, *generator, "-DCMAKE_BUILD_TYPE=Release", "-DFAM_STUDIES=OFF",
             "-DCMAKE_UNITY_BUILD=ON",
             f"-DPython3_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", scratch, "--target", "fam_python"], check=True)
        to = pathlib.Path(self.get_ext_fullpath(extension.name))
        to.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(scratch / to.name, to)
        shutil.copy(project / "python" / "fam.pyi", to.parent)


scratch.mkdir(parents=True, exist_ok=True)
setup(version=version, ext_modules=[Extension("fam", [])], cmdclass={"build_ext": CMakeBuild},
      options={"build": {"build_base": str(scratch / "setuptools")}, "egg_info": {"egg_base": str(scratch)}})
