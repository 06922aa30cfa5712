# SPDX-License-Identifier: BSD-3-Clause
# What parallel, io and drivers link. Not needed with CDCA_WITH_MPI=OFF.

set(MPI_CXX_SKIP_MPICXX ON)
find_package(MPI REQUIRED COMPONENTS CXX)
find_package(METIS REQUIRED)

find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(muparser REQUIRED)
find_package(CLI11 REQUIRED)
find_package(ZLIB REQUIRED)

set(HDF5_PREFER_PARALLEL ON)  # here, and where VTK looks for it
find_package(HDF5 REQUIRED COMPONENTS C)
if(NOT HDF5_IS_PARALLEL)
  message(FATAL_ERROR "HDF5 without MPI was found (${HDF5_C_LIBRARIES}); needed is a parallel one, as of libhdf5-openmpi-dev.")
endif()
add_library(cdca_hdf5 INTERFACE)
target_include_directories(cdca_hdf5 SYSTEM INTERFACE ${HDF5_C_INCLUDE_DIRS})
target_link_libraries(cdca_hdf5 INTERFACE ${HDF5_C_LIBRARIES} MPI::MPI_CXX ZLIB::ZLIB)

# VTK of libvtk9-dev, or the one that paraview-dev brings along.
file(GLOB CDCA_PARAVIEW_VTK LIST_DIRECTORIES true
  "/usr/lib/*/cmake/paraview-*/vtk" "/usr/local/lib/cmake/paraview-*/vtk" "/usr/local/lib/*/cmake/paraview-*/vtk")
find_package(VTK 9.1 REQUIRED CONFIG COMPONENTS CommonCore CommonDataModel IOXML PATHS ${CDCA_PARAVIEW_VTK})
message(STATUS "Found VTK ${VTK_VERSION}: ${VTK_DIR}")
set(CDCA_VTK_TARGETS VTK::CommonCore VTK::CommonDataModel VTK::IOXML)
