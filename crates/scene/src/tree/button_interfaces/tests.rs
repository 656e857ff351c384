//! Persons use user interfaces of V-REP.

use super::*;
use crate::Kind;
use crate::object::dummy::Dummy;

const BUTTON: i32 = button_property::ENABLED;
const HELD: i32 = BUTTON | button_property::DOWN_UP_EVENT;
const SWITCH: i32 = BUTTON | button_property::STAY_DOWN;

fn scene(attributes: i32, buttons: &[(i32, i32)]) -> (Scene, i64) {
    let mut scene = Scene::default();
    let button = |(number, attributes): &(i32, i32)| Button {
        number: *number,
        attributes: *attributes,
        ..Button::default()
    };
    let buttons = buttons.iter().map(button).collect();
    let handle = scene.button_interfaces_mut().add(ButtonInterface {
        attributes,
        buttons,
        ..ButtonInterface::default()
    });
    (scene, handle)
}

/// The events of the next passes, until there are none.
fn events(scene: &mut Scene, handle: i64) -> Vec<(i32, bool, i64)> {
    let mut all = Vec::new();
    loop {
        scene.button_interfaces_mut().next_pass();
        let Some(event) = scene.button_interfaces().event(handle) else {
            return all;
        };
        all.push((
            event.number,
            event.attributes & button_property::IS_DOWN != 0,
            event.slider,
        ));
    }
}

#[test]
fn buttons_are_down_while_they_are_held_and_switches_stay() {
    let (mut scene, ui) = scene(ui_property::VISIBLE, &[(1, BUTTON), (2, HELD), (3, SWITCH)]);
    for number in 1..=3 {
        scene.use_button(ui, number, ButtonInput::Click).unwrap();
    }
    assert_eq!(
        events(&mut scene, ui),
        [(1, false, 0), (2, true, 0), (2, false, 0), (3, true, 0)]
    );
    scene.use_button(ui, 1, ButtonInput::Hold(true)).unwrap();
    assert!(
        scene
            .button_interfaces()
            .get(ui)
            .unwrap()
            .button(1)
            .unwrap()
            .has(button_property::IS_DOWN)
    );
    assert_eq!(events(&mut scene, ui), []);
    scene.use_button(ui, 3, ButtonInput::Click).unwrap();
    scene.use_button(ui, 1, ButtonInput::Hold(false)).unwrap();
    scene.use_button(ui, 1, ButtonInput::Hold(false)).unwrap();
    assert_eq!(events(&mut scene, ui), [(3, false, 0), (1, false, 0)]);
}

#[test]
fn sliders_and_edit_boxes_take_values() {
    let (mut scene, ui) = scene(
        ui_property::VISIBLE,
        &[
            (1, BUTTON | SLIDER),
            (2, BUTTON | EDIT_BOX),
            (3, BUTTON | LABEL),
        ],
    );
    scene.use_button(ui, 1, ButtonInput::Slide(250)).unwrap();
    scene
        .use_button(ui, 1, ButtonInput::Slide(i64::MAX))
        .unwrap();
    scene
        .use_button(ui, 2, ButtonInput::Enter("0.5".into()))
        .unwrap();
    assert_eq!(
        events(&mut scene, ui),
        [(1, false, 250), (1, false, 1000), (2, false, 0)]
    );
    assert_eq!(
        scene
            .button_interfaces()
            .get(ui)
            .unwrap()
            .button(2)
            .unwrap()
            .label,
        "0.5"
    );
    for (number, input) in [
        (1, ButtonInput::Enter("1".into())),
        (2, ButtonInput::Click),
        (3, ButtonInput::Click),
        (4, ButtonInput::Click),
    ] {
        assert!(
            scene
                .use_button(ui, number, input)
                .is_err_and(|reason| !reason.is_empty()),
            "{number}"
        );
    }
    assert_eq!(events(&mut scene, ui), []);
}

#[test]
fn what_is_disabled_or_not_seen_takes_no_inputs() {
    let (mut scene, ui) = scene(0, &[(1, BUTTON)]);
    assert!(scene.use_button(ui, 1, ButtonInput::Click).is_err());
    scene
        .button_interfaces_mut()
        .get_mut(ui)
        .unwrap()
        .attributes = ui_property::VISIBLE;
    for attributes in [0, BUTTON | button_property::IGNORE_MOUSE] {
        scene
            .button_interfaces_mut()
            .get_mut(ui)
            .unwrap()
            .button_mut(1)
            .unwrap()
            .attributes = attributes;
        assert!(
            scene.use_button(ui, 1, ButtonInput::Click).is_err(),
            "{attributes:#x}"
        );
    }
    assert!(scene.use_button(ui + 1, 1, ButtonInput::Click).is_err());
}

#[test]
fn buttons_close_roll_up_and_select() {
    let acts = [
        (1, BUTTON | button_property::ROLL_UP_ACTION),
        (2, BUTTON | button_property::CLOSE_ACTION),
    ];
    let (mut scene, ui) = scene(
        ui_property::VISIBLE | ui_property::SELECT_ASSOCIATED_OBJECT,
        &acts,
    );
    let robot = scene.add("robot", Kind::Dummy(Dummy::new(0.01))).unwrap();
    scene.button_interfaces_mut().get_mut(ui).unwrap().object = Some(robot);
    scene.use_button(ui, 1, ButtonInput::Click).unwrap();
    assert_eq!(scene.selection(), [robot]);
    assert_ne!(
        scene.button_interfaces().get(ui).unwrap().attributes & ui_property::ROLLED_UP,
        0
    );
    scene.use_button(ui, 2, ButtonInput::Click).unwrap();
    assert!(!scene.shows_button_interface(scene.button_interfaces().get(ui).unwrap()));
    assert!(scene.use_button(ui, 1, ButtonInput::Click).is_err());
    assert_eq!(events(&mut scene, ui), [(1, false, 0), (2, false, 0)]);
}

#[test]
fn inputs_that_nobody_reads_are_bounded() {
    let (mut scene, ui) = scene(ui_property::VISIBLE, &[(1, BUTTON)]);
    let refused = (0..3000)
        .filter(|_| scene.use_button(ui, 1, ButtonInput::Click).is_err())
        .count();
    assert_eq!(refused, 2000);
}

#[test]
fn sliders_have_positions_and_other_buttons_have_none() {
    let mut slider = Button {
        attributes: SLIDER | 0x10,
        ..Button::default()
    };
    assert_eq!(slider.slider_position(), Ok(500));
    for (position, expected) in [(0, 0), (250, 250), (1000, 1000), (i64::MAX, 1000), (-7, 0)] {
        slider.set_slider_position(position).expect("a slider");
        assert_eq!(slider.slider_position(), Ok(expected));
    }
    let mut label = Button {
        attributes: 1,
        ..Button::default()
    };
    assert_eq!(label.slider_position(), Err(SceneError::NotASlider));
    assert_eq!(label.set_slider_position(3), Err(SceneError::NotASlider));
}

#[test]
fn interfaces_are_removed_with_their_object() {
    let mut interfaces = ButtonInterfaces::default();
    let of = |object| ButtonInterface {
        name: "panel".into(),
        object,
        ..ButtonInterface::default()
    };
    let handles = [of(None), of(Some(Handle(3))), of(Some(Handle(4)))]
        .map(|interface| interfaces.add(interface));
    assert_eq!(handles, [2_060_006, 2_060_007, 2_060_008]);
    assert_eq!(interfaces.named("panel0"), Some(2_060_007));
    interfaces.forget(&BTreeSet::from([Handle(3)]));
    assert_eq!(
        interfaces
            .iter()
            .map(|(handle, _)| handle)
            .collect::<Vec<_>>(),
        [2_060_006, 2_060_008]
    );
    assert_eq!(
        interfaces.remove(2_060_007),
        Err(SceneError::NoSuchInterface)
    );
    assert_eq!(interfaces.add(of(None)), 2_060_009);
}
