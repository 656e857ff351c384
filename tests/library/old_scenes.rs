//! What only old scenes contain: custom user interfaces of V-REP, groups of inverse kinematics.

use std::path::Path;

use swanilda::scene::joint::{Joint, JointMode, JointType};
use swanilda::scene::object::dummy::Dummy;
use swanilda::scene::tree::button_interfaces::{Button, ButtonInput, ButtonInterface};
use swanilda::scene::tree::ik_groups::{IkElement, IkGroup};
use swanilda::scene::{Data, Handle, Kind, Pose, Scene};
use swanilda::{Options, SceneFile, ScriptKind, Simulator};

/// Runs a customization script, which must not fail.
#[track_caller]
fn run(sim: &mut Simulator, code: &str) {
    let code = format!("function sysCall_init() {code} end");
    if let Err(error) = sim.add_script(ScriptKind::Customization, "test", code.as_bytes()) {
        panic!("{error}");
    }
    assert_eq!(sim.errors(), 0);
}

fn button(number: i32, attributes: i32, label: &str) -> Button {
    Button {
        number,
        attributes,
        span: [number, 1],
        label: label.into(),
        down_label: "down".into(),
        ..Button::default()
    }
}

/// A button, a label and a slider, in cells of 20 times 15 pixels.
fn panel(name: &str, object: Option<Handle>) -> ButtonInterface {
    ButtonInterface {
        name: name.into(),
        attributes: 3,
        cells: [4, 3],
        position: [50, -7],
        cell_size: [20, 15],
        view: 2,
        object,
        rollup: [1, 2, 3, 4],
        buttons: vec![
            button(1, 0x18, "Start"),
            button(2, 0x11, "Speed"),
            button(3, 0x12, ""),
        ],
    }
}

fn simulator() -> Simulator {
    Simulator::new(Options::default())
}

fn dummy(sim: &mut Simulator) -> Handle {
    sim.scene_mut()
        .add("robot", Kind::Dummy(Dummy::new(0.01)))
        .expect("there is room")
}

#[track_caller]
fn loaded(path: &Path) -> Simulator {
    let mut sim = simulator();
    let bytes = std::fs::read(path).expect("the file is there");
    sim.load(SceneFile::read(&bytes).expect("a scene"))
        .expect("there is room");
    sim
}

fn text(path: &Path) -> Data {
    Data::text(path.to_str().expect("a name in UTF-8"))
}

#[test]
fn user_interfaces_are_saved_and_loaded() {
    let folder = tempfile::tempdir().unwrap();
    let mut sim = simulator();
    let robot = dummy(&mut sim);
    for (name, object) in [("panel", None), ("robotPanel", Some(robot))] {
        let mut interface = panel(name, object);
        interface.buttons[2].slider = -0.25;
        interface.buttons[2].colours = [0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0];
        sim.scene_mut().button_interfaces_mut().add(interface);
    }
    let path = folder.path().join("scene.ttt");
    sim.call_api("sim.saveScene", &[text(&path)])
        .expect("the scene is saved");
    let interfaces = |sim: &Simulator| {
        let scene = sim.scene();
        scene
            .button_interfaces()
            .iter()
            .map(|(handle, of)| (handle, of.clone()))
            .collect::<Vec<_>>()
    };
    assert_eq!(interfaces(&sim).len(), 2);
    assert_eq!(interfaces(&sim), interfaces(&loaded(&path)));
    let path = folder.path().join("robot.ttm");
    sim.call_api(
        "sim.setBoolProperty",
        &[robot.raw().into(), Data::text("modelBase"), true.into()],
    )
    .expect("a model");
    sim.call_api("sim.saveModel", &[robot.raw().into(), text(&path)])
        .expect("the model is saved");
    sim.call_api("sim.loadModel", &[text(&path)])
        .expect("the model is loaded");
    let names: Vec<_> = sim
        .scene()
        .button_interfaces()
        .iter()
        .map(|(_, interface)| interface.name.clone())
        .collect();
    assert_eq!(names, ["panel", "robotPanel", "robotPanel0"]);
    sim.call_api("sim.removeObjects", &[vec![robot.raw()].into()])
        .expect("the robot is removed");
    assert_eq!(sim.scene().button_interfaces().named("robotPanel"), None);
    sim.call_api("sim.closeScene", &[])
        .expect("the scene is closed");
    assert_eq!(sim.scene().button_interfaces().iter().count(), 0);
}

#[test]
fn scripts_read_and_write_user_interfaces() {
    let mut sim = simulator();
    sim.scene_mut()
        .button_interfaces_mut()
        .add(panel("panel", None));
    sim.scene_mut()
        .button_interfaces_mut()
        .add(panel("other#3", None));
    run(
        &mut sim,
        "local ui = simGetUIHandle('panel')
        assert(ui == 2060006 and simGet2DElementHandle('panel#') == ui and simGetUIHandle('other#3') == ui + 1)
        assert(simGetUIButtonLabel(ui, 1) == 'Start' and simGetUIButtonLabel(ui, 3) == '')
        assert(simSetUIButtonLabel(ui, 1, nil, 'pressed') == 1 and simGetUIButtonLabel(ui, 1) == 'Start')
        assert(simSet2DElementButtonLabel(ui, 1, 'Stop') == 1 and simGetUIButtonLabel(ui, 1) == 'Stop')
        assert(simGetUIButtonProperty(ui, 2) == 0x11)
        assert(simSetUIButtonProperty(ui, 2, 1) == 1 and simGet2DElementButtonProperty(ui, 2) == 1)
        assert(simGetUIProperty(ui) == 3 and simSetUIProperty(ui, 0x41) == 1 and simGetUIProperty(ui) == 0x41)
        assert(simGetUISlider(ui, 3) == 500 and simSetUISlider(ui, 3, 250) == 1 and simGet2DElementSlider(ui, 3) == 250)
        assert(simGetUIEventButton(ui) == -1 and select('#', simGetUIEventButton(ui)) == 1)
        local place, size = simGetUIPosition(ui), simGetUIButtonSize(ui, 3)
        assert(place[1] == 50 and place[2] == -7 and size[1] == 60 and size[2] == 15)
        assert(simSetUIPosition(ui, {3, 4}) == 1 and simGetUIPosition(ui)[2] == 4)
        assert(simSetUIButtonColor(ui, 1, {1, 0, 0}, nil, {0, 2, 0 / 0}) == 1)
        assert(sim.getUIHandle == nil)",
    );
    let scene = sim.scene();
    let button = scene
        .button_interfaces()
        .get(2_060_006)
        .unwrap()
        .button(1)
        .unwrap()
        .clone();
    assert_eq!(
        (button.label.as_str(), button.down_label.as_str()),
        ("Stop", "pressed")
    );
    assert_eq!(
        button.colours,
        [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0]
    );
}

#[test]
fn what_is_not_there_is_refused() {
    let mut sim = simulator();
    sim.scene_mut()
        .button_interfaces_mut()
        .add(panel("panel", None));
    run(
        &mut sim,
        "local function refused(words, call, ...)
            local ok, e = pcall(call, ...)
            assert(not ok and e:find(words, 1, true), e)
        end
        local ui = simGetUIHandle('panel')
        refused('in simGetUIHandle: UI does not exist.', simGetUIHandle, 'panel@silentError')
        local of_buttons = {simGetUIButtonProperty, simGetUIButtonLabel, simGetUISlider, simGetUIButtonSize}
        for _, call in ipairs(of_buttons) do
            refused('UI does not exist.', call, ui - 1, 1)
            refused('UI button does not exist.', call, ui, 4)
        end
        for _, call in ipairs{simGetUIProperty, simGetUIEventButton, simGetUIPosition, simRemoveUI} do
            refused('UI does not exist.', call, -1)
        end
        refused('UI button does not exist.', simSetUIButtonLabel, ui, 1e300, 'a')
        refused('button is not a slider.', simGetUISlider, ui, 1)
        refused('button is not a slider.', simSetUISlider, ui, 2, 5)
        assert(simSetUISlider(ui, 3, 1e300) == 1 and simGetUISlider(ui, 3) == 1000)
        assert(simSetUISlider(ui, 3, 0 / 0) == 1 and simGetUISlider(ui, 3) == 0)
        assert(simRemoveUI(ui) == 1)
        refused('UI does not exist.', simGetUIHandle, 'panel')
        assert(simRemoveUI(sim.handle_all) == 1)",
    );
}

#[test]
fn what_persons_do_reaches_scripts_in_the_next_step() {
    let mut sim = simulator();
    sim.scene_mut()
        .button_interfaces_mut()
        .add(panel("panel", None));
    let code = "sim = require 'sim'
        function sysCall_init() seen = {} end
        function sysCall_actuation()
            local button, values = simGetUIEventButton(simGetUIHandle('panel'))
            if button >= 0 then seen[#seen + 1] = button .. ':' .. values[1] .. ':' .. values[2] end
            sim.setStringSignal('seen', table.concat(seen, ' '))
        end";
    sim.add_script(swanilda::ScriptKind::Simulation, "", code.as_bytes())
        .expect("a script");
    let ui = sim
        .scene()
        .button_interfaces()
        .named("panel")
        .expect("it was added");
    let press = |sim: &mut Simulator, button: i64, input: ButtonInput| {
        sim.scene_mut()
            .use_button(ui, button, input)
            .expect("it takes that");
    };
    sim.start();
    press(&mut sim, 1, ButtonInput::Click);
    press(&mut sim, 3, ButtonInput::Slide(250));
    for _ in 0..4 {
        sim.iterate();
    }
    press(&mut sim, 1, ButtonInput::Click);
    sim.iterate();
    let seen = sim
        .call_api("sim.getStringSignal", &[Data::text("seen")])
        .expect("a signal");
    assert_eq!(seen, [Data::text("1:280:0 3:18:250 1:24:0")]);
}

/// Two links of half a metre in the plane, in a group that is handled explicitly or not; tip and target.
fn arm(scene: &mut Scene, mode: JointMode, explicit: bool) -> [Handle; 2] {
    let mut parent = None;
    for (x, position) in [(0.0, 0.3), (0.5, 0.6)] {
        let joint = Joint {
            position,
            ..Joint::new(JointType::Revolute, mode)
        };
        let joint = scene
            .add("joint", Kind::Joint(Box::new(joint)))
            .expect("there is room");
        scene.set_parent(joint, parent, false).expect("both exist");
        scene
            .set_local_pose(joint, Pose::translation(x, 0.0, 0.0))
            .expect("it is a place");
        parent = Some(joint);
    }
    let mut dummy = || {
        scene
            .add("dummy", Kind::Dummy(Dummy::new(0.01)))
            .expect("there is room")
    };
    let [tip, target] = [dummy(), dummy()];
    scene.set_parent(tip, parent, false).expect("both exist");
    scene
        .set_local_pose(tip, Pose::translation(0.5, 0.0, 0.0))
        .expect("it is a place");
    scene
        .set_local_pose(target, Pose::translation(0.8, 0.5, 0.0))
        .expect("it is a place");
    scene
        .link_dummies(tip, Some(target))
        .expect("both are dummies");
    let element = IkElement {
        precisions: [0.001, 0.0005],
        constraints: 3,
        ..IkElement::new(tip)
    };
    let group = IkGroup {
        explicit,
        max_iterations: 10,
        elements: vec![element],
        ..IkGroup::new("reach")
    };
    scene.ik_groups_mut().add(group);
    [tip, target]
}

fn distance(sim: &Simulator, ends: [Handle; 2]) -> f64 {
    let scene = sim.scene();
    let [a, b] = ends.map(|end| scene.world_pose(end).expect("it exists").translation.vector);
    (a - b).norm()
}

#[test]
fn groups_of_inverse_kinematics_move_their_joints_in_each_step() {
    let mut sim = Simulator::new(Options::default());
    let ends = arm(&mut sim.scene_mut(), JointMode::InverseKinematics, false);
    assert!(distance(&sim, ends) > 0.01);
    sim.step(2);
    assert!(distance(&sim, ends) < 0.0005);
    sim.scene_mut()
        .set_local_pose(ends[1], Pose::translation(0.5, 0.6, 0.0))
        .expect("it is a place");
    sim.step(2);
    assert!(distance(&sim, ends) < 0.0005);
    // Out of reach: the arm points there.
    sim.scene_mut()
        .set_local_pose(ends[1], Pose::translation(0.0, 2.0, 0.0))
        .expect("it is a place");
    sim.step(20);
    assert_eq!(sim.errors(), 0);
    sim.scene_mut().remove(&[ends[1]]).expect("it exists");
    sim.step(2);
    assert_eq!(sim.errors(), 0);
}

#[test]
fn explicit_groups_and_other_joints_wait() {
    let mut sim = Simulator::new(Options::default());
    let ends = arm(&mut sim.scene_mut(), JointMode::InverseKinematics, true);
    let others = arm(&mut sim.scene_mut(), JointMode::Kinematic, false);
    let before = [ends, others].map(|ends| distance(&sim, ends));
    sim.step(2);
    assert_eq!([ends, others].map(|ends| distance(&sim, ends)), before);
    run(
        &mut sim,
        "local group = simGetIkGroupHandle('reach')
        assert(simHandleIkGroup(group) == 1)
        assert(simHandleIkGroup(sim_handle_all) == 1)
        assert(not pcall(simHandleIkGroup, simGetIkGroupHandle('reach0')))",
    );
    assert!(distance(&sim, ends) < 0.0005);
    assert_eq!(distance(&sim, others), before[1]);
}
