# Headers of the host's libraries for another target. The packages of Eigen and nlohmann_json say that their headers are in
# /usr/include, where the host's C library is, too; links lead to them alone.
set(headers ${CMAKE_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
file(CREATE_LINK /usr/include/nlohmann ${headers}/nlohmann SYMBOLIC)
file(CREATE_LINK /usr/include/eigen3/Eigen ${headers}/Eigen SYMBOLIC)
foreach(package Eigen3::Eigen nlohmann_json::nlohmann_json)
  if(TARGET ${package})
    set_target_properties(${package} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${headers})
  endif()
endforeach()
# the same bytes wherever it is built
target_compile_options(snapthrough_options INTERFACE -ffile-prefix-map=${CMAKE_SOURCE_DIR}/=
  -ffile-prefix-map=${CMAKE_BINARY_DIR}/=)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "wasm32")
  target_include_directories(snapthrough_options SYSTEM INTERFACE ${CMAKE_SOURCE_DIR}/clients/wasm/include)
endif()
