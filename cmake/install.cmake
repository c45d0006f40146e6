# What `cmake --install` and `cpack -G DEB` put in place: the program with its scenes, manual page and completion
# (component drycut), and the library for programs of one's own (component libdrycut-dev).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(reference ${PROJECT_BINARY_DIR}/reference)
add_custom_command(OUTPUT ${reference}/drycut.1 COMMAND drycut reference ${reference} DEPENDS drycut VERBATIM)
add_custom_target(drycut_reference ALL DEPENDS ${reference}/drycut.1)

install(TARGETS drycut COMPONENT drycut)
install(FILES ${reference}/drycut.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT drycut)
install(FILES ${reference}/drycut.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME drycut
        COMPONENT drycut)
install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/drycut COMPONENT drycut PATTERN meshes EXCLUDE)

# The OPC UA gateway; its packages (component opcua) only where make opcua has fetched them.
file(GLOB gateway CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/opcua/*.mjs ${PROJECT_SOURCE_DIR}/opcua/*.json)
install(FILES ${gateway} DESTINATION ${CMAKE_INSTALL_DATADIR}/drycut/opcua COMPONENT drycut)
install(DIRECTORY ${PROJECT_BINARY_DIR}/opcua/node_modules DESTINATION ${CMAKE_INSTALL_DATADIR}/drycut/opcua
        COMPONENT opcua EXCLUDE_FROM_ALL OPTIONAL)

set(config ${CMAKE_INSTALL_LIBDIR}/cmake/drycut)
install(TARGETS drycut_base drycut_devices drycut_plants drycut_loop EXPORT drycut COMPONENT libdrycut-dev)
install(DIRECTORY include/drycut DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT libdrycut-dev)
install(EXPORT drycut NAMESPACE drycut:: FILE drycutTargets.cmake DESTINATION ${config} COMPONENT libdrycut-dev)
file(WRITE ${PROJECT_BINARY_DIR}/drycutConfig.cmake
     "include(\${CMAKE_CURRENT_LIST_DIR}/dependencies.cmake)\ninclude(\${CMAKE_CURRENT_LIST_DIR}/drycutTargets.cmake)\n")
write_basic_package_version_file(${PROJECT_BINARY_DIR}/drycutConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/drycutConfig.cmake ${PROJECT_BINARY_DIR}/drycutConfigVersion.cmake
        cmake/dependencies.cmake DESTINATION ${config} COMPONENT libdrycut-dev)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "virtual commissioning for cut-to-length lines")
set(CPACK_PACKAGE_CONTACT "Drycut maintainers <maintainers@drycut.example>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_DRYCUT_PACKAGE_NAME drycut)
set(CPACK_DEBIAN_DRYCUT_PACKAGE_SHLIBDEPS ON)
# What is loaded when it is first needed is not seen by dpkg-shlibdeps: the packages of these libraries.
set(loaded "")
foreach(library osmesa assimp hdf5)
  list(GET ${library}_LINK_LIBRARIES 0 file)
  get_filename_component(file ${file} REALPATH)
  execute_process(COMMAND dpkg-query -S ${file} OUTPUT_VARIABLE package ERROR_QUIET)
  if(package MATCHES "^([^:]+):")
    string(APPEND loaded ", ${CMAKE_MATCH_1}")
  endif()
endforeach()
set(CPACK_DEBIAN_DRYCUT_PACKAGE_DEPENDS "fonts-dejavu-core${loaded}")
set(CPACK_DEBIAN_DRYCUT_PACKAGE_RECOMMENDS "libjs-dygraphs, libjs-three, ffmpeg")
set(CPACK_DEBIAN_PYTHON3-DRYCUT_PACKAGE_NAME python3-drycut)
set(CPACK_DEBIAN_PYTHON3-DRYCUT_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON3-DRYCUT_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON3-DRYCUT_PACKAGE_DEPENDS "python3, python3-numpy${loaded}")
set(CPACK_DEBIAN_PYTHON3-DRYCUT_PACKAGE_RECOMMENDS "drycut, python3-pandas")
set(CPACK_DEBIAN_LIBDRYCUT-DEV_PACKAGE_NAME libdrycut-dev)
set(CPACK_DEBIAN_LIBDRYCUT-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBDRYCUT-DEV_PACKAGE_DEPENDS
    "pkg-config, libbullet-dev, libyaml-cpp-dev, libudunits2-dev, libminizip-dev, libpugixml-dev, libfmt-dev, libeigen3-dev, nlohmann-json3-dev")
