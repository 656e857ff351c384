//! Scripts in Python.

mod interpreters;
mod scripts;
