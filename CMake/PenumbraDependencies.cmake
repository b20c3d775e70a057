# penumbra_find(<package> <description> [argument...]) finds a package; one error names all that are missing.
set(penumbra_missing "")
macro (penumbra_find package description)
  find_package(${package} ${ARGN} QUIET)
  if (NOT ${package}_FOUND)
    string(APPEND penumbra_missing "\n  ${description}")
  endif ()
endmacro ()

# VTK, selected by CMAKE_PREFIX_PATH or VTK_DIR, and the other libraries.
set(penumbra_vtk_components
  ChartsCore CommonCore CommonDataModel CommonExecutionModel CommonColor CommonMath CommonTransforms
  FiltersCore FiltersExtraction FiltersGeneral FiltersGeometry FiltersModeling FiltersSources
  FiltersHybrid FiltersTexture
  ImagingCore ImagingSources InteractionStyle InteractionWidgets IOCore IOGeometry IOImage IOLegacy IOParallelXML IOPLY IOXML IOImport IOExodus IOEnSight ParallelCore
  RenderingAnnotation RenderingContext2D RenderingCore RenderingFreeType RenderingOpenGL2 RenderingLabel
  RenderingContextOpenGL2 RenderingVolume RenderingVolumeOpenGL2 vtksys)
set(penumbra_vtk_readers IOCGNSReader IOHDF IOXdmf2)
if (PENUMBRA_BUILD_PYTHON)
  find_package(Python3 3.12 REQUIRED COMPONENTS Interpreter Development.Module)
  list(APPEND penumbra_vtk_components Python WrappingPythonCore)
endif ()
# ParaView contains its own VTK, which needs the Python that ParaView was built with.
if (PENUMBRA_BUILD_PLUGIN)
  find_package(Python3 REQUIRED COMPONENTS Interpreter Development)
  find_package(ParaView 5.11...<5.12 QUIET COMPONENTS RemotingCore RemotingServerManager RemotingViews)
  if (NOT ParaView_FOUND)
    message(FATAL_ERROR "The plugin needs ParaView 5.11 (found: ${ParaView_CONSIDERED_VERSIONS}). "
      "Set ParaView_DIR, or leave PENUMBRA_BUILD_PLUGIN off. ${ParaView_NOT_FOUND_MESSAGE}")
  endif ()
endif ()
penumbra_find(VTK "VTK 9.1 to 9.7 with headers: libvtk9-dev, vtk-devel, or VTK_DIR. "
  COMPONENTS ${penumbra_vtk_components} OPTIONAL_COMPONENTS ${penumbra_vtk_readers})
if (NOT VTK_FOUND)
  string(APPEND penumbra_missing "${VTK_NOT_FOUND_MESSAGE}")
endif ()
if (VTK_FOUND AND PENUMBRA_INSTALL_VTK_PATH AND NOT PENUMBRA_BUILD_PYTHON)
  list(APPEND CMAKE_INSTALL_RPATH "$<TARGET_FILE_DIR:VTK::vtksys>")
endif ()

find_package(embree 4 CONFIG QUIET)
if (NOT embree_FOUND)
  penumbra_find(embree "Embree 3.13 or 4: libembree-dev, embree-devel, or embree_DIR" 3.13 CONFIG)
endif ()
penumbra_find(glm "GLM: libglm-dev, glm-devel, or glm_DIR" CONFIG)
if (PENUMBRA_BUILD_COMMAND)
  penumbra_find(CLI11 "CLI11: libcli11-dev, cli11-devel, CLI11_DIR, or PENUMBRA_BUILD_COMMAND=OFF" CONFIG)
  penumbra_find(nlohmann_json
    "JSON for Modern C++: nlohmann-json3-dev, json-devel, nlohmann_json_DIR, or PENUMBRA_BUILD_COMMAND=OFF" CONFIG)
endif ()
if (BUILD_TESTING)
  penumbra_find(GTest "GoogleTest: libgtest-dev, gtest-devel, GTest_DIR, or BUILD_TESTING=OFF" CONFIG)
endif ()
if (penumbra_missing)
  message(FATAL_ERROR "These packages are missing or cannot be used (of Debian, Fedora, or by a variable):"
    "${penumbra_missing}\nDocumentation/GettingStarted.md lists all of them.")
endif ()
