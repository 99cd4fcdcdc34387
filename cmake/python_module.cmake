# The module `restlab` of Python: experiments/python. AUTO builds it where pybind11 and numpy are installed.
set(RESTLAB_PYTHON AUTO CACHE STRING "Build the Python module: AUTO, ON or OFF")
set_property(CACHE RESTLAB_PYTHON PROPERTY STRINGS AUTO ON OFF)

# Sets <result> to why the module cannot be built; "" where it can.
function(rl_why_no_python result)
  set(${result} "" PARENT_SCOPE)
  if(RESTLAB_SANITIZE OR RESTLAB_FUZZ)
    set(${result} "RESTLAB_PYTHON: an interpreter cannot load a sanitizer's build" PARENT_SCOPE)
  elseif(NOT Python_FOUND)
    set(${result} "missing library: Python 3.9 or later with numpy (packages python3-dev, python3-numpy)"
        PARENT_SCOPE)
  elseif(NOT TARGET pybind11::module)
    set(${result} "missing library: pybind11 (package pybind11-dev)" PARENT_SCOPE)
  endif()
endfunction()

if(RESTLAB_PYTHON)
  # The distribution's, for which packages.txt has the packages; -DPython_EXECUTABLE=... is another one.
  if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python_EXECUTABLE /usr/bin/python3)
  endif()
  find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module NumPy)
  if(Python_FOUND)
    find_package(pybind11 QUIET CONFIG)
  endif()
  rl_why_no_python(_why)
  if(NOT _why)
    add_subdirectory(experiments/python)
  elseif(NOT RESTLAB_PYTHON STREQUAL "AUTO")
    message(NOTICE "${_why}") # ./lab looks for its beginning
    # Else every later call would stop here, too.
    set(RESTLAB_PYTHON AUTO CACHE STRING "Build the Python module: AUTO, ON or OFF" FORCE)
    message(FATAL_ERROR "RESTLAB_PYTHON is ON, but the module cannot be built")
  endif()
endif()
