# VTK, selected by CMAKE_PREFIX_PATH or VTK_DIR, and the other libraries.
set(penumbra_vtk_components
  ChartsCore CommonCore CommonDataModel CommonExecutionModel CommonColor CommonMath CommonTransforms
  FiltersCore FiltersExtraction FiltersGeneral FiltersGeometry FiltersModeling FiltersSources
  FiltersHybrid FiltersTexture
  ImagingCore ImagingSources InteractionStyle IOCore IOGeometry IOImage IOLegacy IOParallelXML IOPLY IOXML IOImport IOExodus IOEnSight ParallelCore
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
find_package(VTK REQUIRED
  COMPONENTS ${penumbra_vtk_components} OPTIONAL_COMPONENTS ${penumbra_vtk_readers})
if (PENUMBRA_INSTALL_VTK_PATH AND NOT PENUMBRA_BUILD_PYTHON)
  list(APPEND CMAKE_INSTALL_RPATH "$<TARGET_FILE_DIR:VTK::vtksys>")
endif ()

find_package(embree 4 CONFIG QUIET)
if (NOT embree_FOUND)
  find_package(embree 3.13 CONFIG REQUIRED)
endif ()
find_package(glm CONFIG REQUIRED)

if (PENUMBRA_BUILD_COMMAND)
  find_package(CLI11 CONFIG REQUIRED)
  find_package(nlohmann_json CONFIG REQUIRED)
endif ()
if (BUILD_TESTING)
  find_package(GTest CONFIG REQUIRED)
endif ()
