//! The viewer's page in a browser.

use crate::web::check_in_browser;

#[test]
fn the_page_in_a_browser() {
    check_in_browser("view_browser.py");
}
