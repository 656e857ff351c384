//! Reports of `swanilda test` before those who read them.

use crate::web::{check, check_in_browser};

#[test]
fn readers_of_junit_and_tap() {
    check("reports.py");
}

#[test]
fn the_page_in_a_browser() {
    check_in_browser("reports_browser.py");
}
