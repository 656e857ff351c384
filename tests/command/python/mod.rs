//! Scripts in Python.

mod built;
mod interpreters;
mod scripts;
