# The Debian packages that CPack makes (scripts/package.sh): the program with its service, the shared library, and what a
# program is compiled with. Included at the end of CMakeLists.txt; with SNAPTHROUGH_PACKAGE=OFF nothing is done here.
option(SNAPTHROUGH_PACKAGE "Install the files of the Debian packages, too; needs -DCMAKE_INSTALL_PREFIX=/usr" OFF)
if(NOT SNAPTHROUGH_PACKAGE)
  return()
endif()
if(NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  message(FATAL_ERROR "SNAPTHROUGH_PACKAGE: the unit names /usr/bin/snapthrough, so CMAKE_INSTALL_PREFIX is to be /usr, "
    "not ${CMAKE_INSTALL_PREFIX}")
endif()
set(debian ${CMAKE_CURRENT_LIST_DIR})
set(made ${CMAKE_CURRENT_BINARY_DIR}/debian)
set(packages programs development)
if(TARGET snapthrough_shared)
  list(APPEND packages library python)
  if(NOT TARGET python_package)
    message(FATAL_ERROR "SNAPTHROUGH_PACKAGE: python3 makes parts of the Python package, and is not there")
  endif()
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/clients/python/snapthrough DESTINATION lib/python3/dist-packages COMPONENT python
    PATTERN __pycache__ EXCLUDE)
endif()

# The service.
install(FILES ${debian}/snapthrough.service DESTINATION /lib/systemd/system COMPONENT programs)
install(FILES ${debian}/config.toml DESTINATION /etc/snapthrough COMPONENT programs)

# Documents: what a user of the package reads. Pictures of the page and reports of measurements stay with the sources.
# Requests and results are those of the build, with their tables of fields.
file(GLOB documents CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/*.md ${PROJECT_SOURCE_DIR}/docs/*.svg)
list(FILTER documents EXCLUDE REGEX "/(requests|results)\\.md$")
install(DIRECTORY ${CMAKE_BINARY_DIR}/pages/docs/ DESTINATION share/doc/snapthrough/docs COMPONENT programs)
install(FILES ${PROJECT_SOURCE_DIR}/README.md DESTINATION share/doc/snapthrough COMPONENT programs)
install(FILES ${documents} DESTINATION share/doc/snapthrough/docs COMPONENT programs)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/howto ${PROJECT_SOURCE_DIR}/docs/decisions
  DESTINATION share/doc/snapthrough/docs COMPONENT programs)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION share/doc/snapthrough COMPONENT programs)

# What each package has to say of itself: its licence and what changed.
file(READ ${PROJECT_SOURCE_DIR}/LICENSE licence)
string(REGEX MATCH "Copyright [^\n]*" copyright_line "${licence}")
string(REGEX REPLACE "^Copyright (\\(c\\) )?" "" copyright_holder "${copyright_line}")
string(REGEX REPLACE "^.*(Permission is hereby granted.*)$" "\\1" licence_text "${licence}")
string(STRIP "${licence_text}" licence_text)
string(REPLACE "\n\n" "\n.\n" licence_text "${licence_text}")
string(REPLACE "\n" "\n " licence_text " ${licence_text}")
configure_file(${debian}/copyright.in ${made}/copyright @ONLY)

set(SNAPTHROUGH_PACKAGE_MAINTAINER "the snapthrough authors <maintainers@snapthrough.invalid>" CACHE STRING
  "Who answers for the packages: Name <address>")
set(SNAPTHROUGH_PACKAGE_VERSION "" CACHE STRING "Version of the packages, without Debian's revision; empty: the program's")
if(SNAPTHROUGH_PACKAGE_VERSION)
  set(CPACK_PACKAGE_VERSION ${SNAPTHROUGH_PACKAGE_VERSION})
else()
  set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
endif()
set(package_version ${CPACK_PACKAGE_VERSION}-1)
string(TIMESTAMP package_date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH, if that is set
configure_file(${debian}/changelog.in ${made}/changelog.Debian @ONLY)
configure_file(${PROJECT_SOURCE_DIR}/CHANGELOG.md ${made}/changelog COPYONLY)
foreach(name changelog changelog.Debian)
  execute_process(COMMAND gzip --best --no-name --force --keep ${made}/${name} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
set(programs_name snapthrough)
set(library_name libsnapthrough1)
set(development_name libsnapthrough-dev)
set(python_name python3-snapthrough)
foreach(package IN LISTS packages)
  install(FILES ${made}/copyright ${made}/changelog.gz ${made}/changelog.Debian.gz
    DESTINATION share/doc/${${package}_name} COMPONENT ${package})
endforeach()

# Of all packages.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME snapthrough)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/packages)
set(CPACK_PACKAGE_CONTACT "${SNAPTHROUGH_PACKAGE_MAINTAINER}")
set(CPACK_COMPONENTS_ALL ${packages})
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_SET_DESTDIR ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR})

# snapthrough
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME ${programs_name})
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS adduser)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS librsvg2-bin)  # figures as PNG
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION "stability of slender structures on elastic bases
Computes how beams, columns, piles, arches (tunnels), rings (buried pipes) and
plane frames lose stability when they press on, or are held by, an elastic
base: the equilibrium path at large displacements with contact as part of the
answer, its limit points and bifurcations.

This package has the command line and the HTTP service with its job queue,
which runs as snapthrough.service and listens on this machine only until keys
are set in /etc/snapthrough/config.toml.")
file(WRITE ${made}/conffiles "/etc/snapthrough/config.toml\n")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_CONTROL_EXTRA
  "${made}/conffiles;${debian}/postinst;${debian}/prerm;${debian}/postrm")

# libsnapthrough1
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${library_name})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
file(WRITE ${made}/shlibs "libsnapthrough 1 ${library_name} (>= ${CPACK_PACKAGE_VERSION})\n")
file(WRITE ${made}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA "${made}/shlibs;${made}/triggers")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "stability of slender structures on elastic bases, as a shared library
The solver of snapthrough behind a C interface: a request document in, a result
document out, in the process of the caller and without a service.")

# libsnapthrough-dev
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME ${development_name})
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "stability of slender structures on elastic bases, for compiling programs
Headers and archive of snapthrough's solver for C++20 with their CMake package
and, where the shared library is packaged, its C header and pkg-config file.")
if(TARGET snapthrough_shared)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${library_name} (= ${package_version})")
endif()

# python3-snapthrough: no compiled module, so that it serves every version of Python and every architecture
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME ${python_name})
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.9)")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "${library_name}, python3-matplotlib")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "stability of slender structures on elastic bases, for Python
Models, analyses, sweeps and results of snapthrough as typed Python, in process
with libsnapthrough1 or by a service. Needs the standard library only; data
frames and plots use pandas and matplotlib where they are there.")

include(CPack)
