//! Any text as a piece of MJCF, as attributes of a `<flexcomp>` and as what is inside of one and of a `<composite>`: a soft thing whose numbers are finite and whose
//! indices have nodes, which a shape can be made of or which is refused. As a tendon, a motor or an adhesion: its numbers are finite.
//!
//! `cargo fuzz run mjcf_fragment`
#![no_main]

use format::robot_file::SoftShape;
use libfuzzer_sys::fuzz_target;
use robot_description::mjcf::{Actuator, Adhesion, Element, Flex, FlexForm, Fragment, Tendon, TendonPart, pose_of_element};

fn check(flex: &Flex) {
    let count = flex.points.len();
    assert!(flex.nodes.iter().chain(flex.pins.iter().map(|pin| &pin.node)).all(|node| *node < count));
    assert!(flex.points.as_flattened().iter().all(|x| x.is_finite()));
    let indices: Vec<u32> = match &flex.form {
        FlexForm::Line { .. } => Vec::new(),
        FlexForm::Sheet { triangles, .. } => triangles.as_flattened().to_vec(),
        FlexForm::Solid { triangles, tetrahedra, .. } => [triangles.as_flattened(), tetrahedra.as_flattened()].concat(),
    };
    assert!(indices.iter().all(|index| (*index as usize) < count));
    let _ = SoftShape::new(flex);
}

fn check_others(element: &Element) {
    if let Ok((tendon, _)) = Tendon::of_element(element) {
        let numbers = [tendon.stiffness, tendon.damping, tendon.friction, tendon.armature];
        assert!(numbers.iter().all(|x| x.is_finite() && *x >= 0.0));
        let ranges = [tendon.rest, tendon.range].into_iter().flatten();
        assert!(ranges.into_iter().all(|[low, high]| low <= high));
        let is_fine = |part: &TendonPart| match part {
            TendonPart::Site(_) => true,
            TendonPart::Pulley(divisor) => *divisor > 0.0,
            TendonPart::Joint(_, factor) => factor.is_finite(),
        };
        assert!(!tendon.path.is_empty() && tendon.path.iter().all(is_fine));
    }
    if let Ok((actuator, ..)) = Actuator::of_element(element) {
        assert!(!actuator.bias.is_nan());
    }
    let _ = Adhesion::of_element(element);
    let (pose, _) = pose_of_element(element);
    assert!(pose.to_homogeneous().iter().all(|x| x.is_finite()));
}

fuzz_target!(|text: &str| {
    let inside = [
        text.to_owned(),
        format!("<flexcomp count='4 3 1'><edge equality='true'/>{text}</flexcomp>"),
        format!("<flexcomp {text}><edge stiffness='1'/></flexcomp>"),
        format!("<spatial {text}><site site='a'/><site site='b'/></spatial>"),
        format!("<fixed><joint joint='a' coef='1'/>{text}</fixed>"),
        format!("<general joint='a' {text}/>"),
        format!("<composite type='cable' count='5 1 1'><geom size='.01'/>{text}</composite>"),
        format!("<composite count='5 3 3' spacing='.1' {text}><geom size='.01'/></composite>"),
    ];
    for text in inside {
        let Ok(fragment) = Fragment::read(&text) else { continue };
        for element in &fragment.elements {
            if let Ok((flex, _)) = Flex::of_element(element, "B1_1") {
                check(&flex);
            }
            check_others(element);
        }
    }
    let _ = Fragment::element("flexcomp", text);
});
