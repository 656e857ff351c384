//! Scripts in Python.

mod built;
mod interfaces;
mod interpreters;
mod scripts;
