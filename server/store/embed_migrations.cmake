# Turns the numbered files DIR/NNNN_name.sql into one C++ source that defines embedded_migrations(), in order.
# The executable then carries its own schema and needs no file at run time.
# HEADER declares it, in namespace snapthrough::server::NAMESPACE.
function(embed_migrations dir namespace header output)
  file(GLOB files CONFIGURE_DEPENDS ${dir}/*.sql)
  list(SORT files)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})
  set(rows "")
  set(expected 1)
  foreach(file IN LISTS files)
    get_filename_component(name ${file} NAME_WE)
    if(NOT name MATCHES "^([0-9][0-9][0-9][0-9])_([a-z0-9_]+)$")
      message(FATAL_ERROR "Migration ${file}: the name must be NNNN_lower_case.sql")
    endif()
    string(REGEX REPLACE "^0+" "" version ${CMAKE_MATCH_1})
    if(NOT version EQUAL expected)
      message(FATAL_ERROR "Migration ${file}: number ${expected} was expected")
    endif()
    math(EXPR expected "${expected} + 1")
    file(READ ${file} sql)
    file(SHA256 ${file} checksum)
    string(APPEND rows "      {${version}, \"${name}\", \"${checksum}\", R\"sql(${sql})sql\"},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${output} CONTENT "// Generated from ${dir} by embed_migrations.cmake.
#include \"${header}\"

namespace snapthrough::server::${namespace} {

const std::vector<Migration>& embedded_migrations() {
  static const std::vector<Migration> migrations{
${rows}  };
  return migrations;
}

}  // namespace snapthrough::server::${namespace}
")
endfunction()
