"""One module for each program: TITLE, VERSION, and `checks`, the ways to check an edge."""

INSTALL = {
    "ours": "pip install ./doors/python",
    "mujoco": "pip install 'mujoco>=4'",
    "coal": "pip install coal pin",
    "drake": "pip install drake, whose versions depend on that of Python: 1.58 is for 3.12, 1.51 for 3.11",
    "hpp": "pip install hpp-python, and set LD_LIBRARY_PATH to cmeel.prefix/lib in site-packages",
    "tesseract": "pip install tesseract-robotics coal pin",
    "vamp": "pip download --no-deps --no-binary :all: vamp-planner, then see the first lines of peers/vamp.cpp",
}
