# Blanks defaulted, deleted, moving and destroying members that have no comment of their own: there is
# nothing to say of them, and doxygen would ask. The lines stay, so that warnings name the right ones.
{
  special = /[)a-z] = (default|delete);$/ ||
            /^ *(virtual )?~[A-Za-z]+\(\)[a-z ]*;$/ ||
            /^ *([A-Za-z]+& operator=|[A-Za-z]+)\([A-Za-z]+&&\) noexcept;$/
  commented = previous ~ /^ *\/\/\// && previous !~ /@}$/
  print special && !commented ? "" : $0
  previous = $0
}
