# Fails when the shipped program could do what it never does (talk to a network, start other programs, take
# another user's rights), or was linked without what makes faults harder to abuse.
# Usage: cmake -DPROGRAM=FILE -DREADELF=FILE -P check_program.cmake
cmake_minimum_required(VERSION 3.25)

function(read_program option out)
  execute_process(
    COMMAND ${READELF} -W ${option} ${PROGRAM}
    OUTPUT_VARIABLE text
    RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${PROGRAM} cannot be read")
  endif()
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

set(never
    socket connect bind listen accept sendto recvfrom getaddrinfo  # a network
    system popen fork vfork posix_spawn posix_spawnp execl execlp execv execve execvp execvpe  # other programs
    setuid setgid setreuid setregid setresuid setresgid setgroups capset)  # another user's rights
read_program(--dyn-syms symbols)
if(NOT symbols MATCHES " UND open")
  message(FATAL_ERROR "${PROGRAM}: these are no symbols of a program that opens files")
endif()
foreach(name IN LISTS never)
  if(symbols MATCHES " UND ${name}[@\n]")
    message(SEND_ERROR "${PROGRAM} can call ${name}")
  endif()
endforeach()

function(expect option pattern what)
  read_program(${option} text)
  if(NOT text MATCHES "${pattern}")
    message(SEND_ERROR "${PROGRAM}: no ${what}")
  endif()
endfunction()

expect(-h "Type: +DYN" "position-independent code")
expect(-l "GNU_RELRO" "relocations that are read-only")
expect(-d "BIND_NOW" "binding at the start")
expect(-l "GNU_STACK +[^\n]* RW +" "stack that cannot be executed")
expect(--dyn-syms "__stack_chk_fail" "stack protector")
read_program(-d dynamic)
if(dynamic MATCHES "RPATH|RUNPATH")
  message(SEND_ERROR "${PROGRAM} looks for libraries in folders of its own")
endif()
