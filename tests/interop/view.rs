//! The viewer's page in a browser.

use std::path::{Path, PathBuf};

use swanilda::scene::Data;
use swanilda::scene::tree::button_interfaces::{Button, ButtonInterface};
use swanilda::{Options, Simulator};

use crate::web::{check_in_browser, check_in_browser_with};

#[test]
fn the_page_in_a_browser() {
    check_in_browser("view_browser.py");
}

#[test]
fn scripts_are_changed_in_a_browser() {
    check_in_browser("view_script.py");
}

#[test]
fn scripts_are_debugged_in_a_browser() {
    check_in_browser("view_debug.py");
}

#[test]
fn scripts_are_changed_without_the_editor_component() {
    check_in_browser_with("view_script.py", &[Path::new("plain")]);
}

#[test]
fn a_capture_in_a_browser() {
    check_in_browser("view_capture.py");
}

#[test]
fn a_robot_is_built_in_a_browser() {
    check_in_browser("view_studio.py");
}

#[test]
fn windows_of_scripts_in_a_browser() {
    check_in_browser_with("view_windows.py", &[&old_scene("view_windows.ttt")]);
}

#[test]
fn values_of_objects_in_a_browser() {
    check_in_browser("view_values.py");
}

#[test]
fn curves_of_live_runs_in_a_browser() {
    check_in_browser("view_plots.py");
}

#[test]
fn joints_of_models_in_a_browser() {
    check_in_browser("view_joints.py");
}

#[test]
fn ways_to_look_at_a_scene_in_a_browser() {
    check_in_browser("view_sights.py");
}

#[test]
fn frames_and_notices_in_a_browser() {
    check_in_browser_with("view_frames.py", &[&old_scene("view_frames.ttt")]);
}

/// A scene with a user interface of V-REP, which no script can make.
fn old_scene(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let mut sim = Simulator::new(Options::default());
    let button = |number: i32, attributes: i32, cell: [i32; 2], span: [i32; 2], label: &str| {
        let colours = [0.2, 0.5, 0.3, 0.8, 0.4, 0.2, 1.0, 1.0, 1.0];
        Button {
            number,
            attributes,
            cell,
            span,
            label: label.into(),
            colours,
            ..Button::default()
        }
    };
    let buttons = vec![
        button(1, 0x10, [0, 0], [4, 1], "Start"),
        button(2, 0x18, [4, 0], [4, 1], "Hold <b>"),
        button(3, 0x12, [0, 1], [8, 1], "Speed"),
        button(4, 0x13, [0, 2], [8, 1], "0.5"),
        button(5, 0x11, [0, 3], [8, 1], "a label && more"),
    ];
    let (cells, cell_size) = ([8, 4], [20, 16]);
    let interface = ButtonInterface {
        name: "Controls".into(),
        attributes: 3,
        cells,
        cell_size,
        buttons,
        ..Default::default()
    };
    sim.scene_mut().button_interfaces_mut().add(interface);
    let name = Data::text(path.to_str().expect("a name in UTF-8"));
    sim.call_api("sim.saveScene", &[name])
        .expect("the scene is saved");
    path
}
