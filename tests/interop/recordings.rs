//! Recordings read by others: `recordings_mcap.py` with the readers of MCAP and Foxglove, `recordings_page.py` in a browser.

use crate::web::{check, check_in_browser};

#[test]
fn mcap_files_are_read_by_foxglove_s_own_messages() {
    check("recordings_mcap.py");
}

#[test]
fn one_file_plays_in_a_browser() {
    check_in_browser("recordings_page.py");
}
