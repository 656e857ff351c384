//! Nodes beside those that MuJoCo 4.0 makes of the same text.

use crate::mjcf::{self, Files, Flex, FlexForm, Fragment};

use super::*;

fn flexcomp(attributes: &str) -> Result<Flex, String> {
    let text = format!("<flexcomp {attributes}><edge stiffness='5'/></flexcomp>");
    let fragment = Fragment::read(&text).map_err(|error| error.to_string())?;
    Flex::of_element(&fragment.elements[0], "base").map(|(flex, _)| flex)
}

fn are_at(flex: &Flex, places: &[(usize, [f64; 3])]) {
    for (node, place) in places {
        let apart = Vector3::from(flex.points[*node]) - Vector3::from(*place);
        assert!(apart.norm() < 1e-9, "{node}: {:?}", flex.points[*node]);
    }
}

fn solid(flex: &Flex) -> (&[[u32; 3]], &[[u32; 4]]) {
    match &flex.form {
        FlexForm::Solid {
            triangles,
            tetrahedra,
            ..
        } => (triangles, tetrahedra),
        other => panic!("no solid: {other:?}"),
    }
}

fn volume(flex: &Flex) -> f64 {
    let of_one = |corners: &[u32; 4]| {
        let [a, b, c, d] = corners.map(|corner| Vector3::from(flex.points[corner as usize]));
        let volume = (b - a).cross(&(c - a)).dot(&(d - a)) / 6.0;
        assert!(volume > 0.0, "{corners:?}");
        volume
    };
    solid(flex).1.iter().map(of_one).sum()
}

#[test]
fn a_box_has_nodes_around_a_middle_one() {
    let flex = flexcomp("type='box' count='4 3 5' spacing='1 1 1'").expect("a box");
    assert_eq!(flex.points.len(), 55);
    let of_corner = |[x, y, z]: [f64; 3]| [x - 1.5, y - 1.0, z - 2.0];
    let places = [
        (0, [1.5, 1.0, 2.0]),
        (1, [0.0; 3]),
        (3, [0.0, 2.0, 0.0]),
        (13, [0.0, 0.0, 4.0]),
        (25, [0.0, 0.0, 1.0]),
        (36, [3.0, 0.0, 3.0]),
        (37, [0.0, 2.0, 1.0]),
        (49, [0.0, 1.0, 1.0]),
        (54, [3.0, 1.0, 3.0]),
    ];
    are_at(&flex, &places.map(|(node, place)| (node, of_corner(place))));
    assert_eq!((solid(&flex).0.len(), solid(&flex).1.len()), (104, 104));
    assert!((volume(&flex) - 24.0).abs() < 1e-9);
}

#[test]
fn cylinders_and_ellipsoids_are_boxes_moved_inwards() {
    let cylinder = flexcomp("type='cylinder' count='4 4 4' spacing='.1 .1 .1' dim='3'");
    let corner = [-0.106_066_017_177_982_14, -0.106_066_017_177_982_14, -0.15];
    let side = [-0.142_302_494_707_577_08, -0.047_434_164_902_525_7, -0.15];
    are_at(&cylinder.expect("a cylinder"), &[(1, corner), (2, side)]);
    let ellipsoid = flexcomp("type='ellipsoid' count='4 5 6' spacing='.1 .1 .1'");
    let flex = ellipsoid.expect("an ellipsoid");
    let places = [
        (
            1,
            [-0.086_602_540_378, -0.115_470_053_838, -0.144_337_567_297],
        ),
        (
            6,
            [-0.034_412_360_081, -0.137_649_440_322, -0.172_061_800_403],
        ),
    ];
    are_at(&flex, &places);
    assert!(volume(&flex) > 0.0);
}

#[test]
fn discs_are_squares_moved_inwards() {
    let square = flexcomp("type='square' count='4 4 1' spacing='.1 .1 .1'").expect("a square");
    are_at(
        &square,
        &[(0, [-0.15, -0.15, 0.0]), (7, [-0.05, 0.15, 0.0])],
    );
    let disc = flexcomp("type='disc' count='5 3 1' spacing='.1 .1 .1'").expect("a disc");
    let places = [
        (
            0,
            [-0.035_777_087_639_996_64, -0.008_944_271_909_999_16, 0.0],
        ),
        (1, [-0.04, 0.0, 0.0]),
        (6, [0.0, -0.01, 0.0]),
    ];
    are_at(&disc, &places);
}

#[test]
fn nodes_and_elements_may_be_listed() {
    let points = "point='0 0 0 1 0 0 0 1 0 0 0 1'";
    let flex = flexcomp(&format!("type='direct' dim='3' {points} element='0 2 1 3'"));
    assert!((volume(&flex.expect("a tetrahedron")) - 1.0 / 6.0).abs() < 1e-12);
    let sheet = flexcomp(&format!("type='direct' {points} element='0 1 2 1 3 2'"));
    let form = sheet.expect("a sheet").form;
    assert!(
        matches!(form, FlexForm::Sheet { triangles, .. } if triangles == [[0, 1, 2], [1, 3, 2]])
    );
    let rope = flexcomp(&format!(
        "type='direct' dim='1' {points} element='0 1 1 2 2 3'"
    ));
    let form = rope.expect("a rope").form;
    assert!(matches!(
        form,
        FlexForm::Line {
            straight: false,
            ..
        }
    ));
    for (attributes, reason) in [
        (
            "dim='1' element='0 1 1 3 3 2'",
            "link each node with the next",
        ),
        ("element='0 1'", "no list of 3 indices"),
        ("element='0 1 4'", "index of no point"),
        ("dim='4' element='0 1 2'", "no dimension 4"),
        ("", "it has no element"),
    ] {
        let refused = flexcomp(&format!("type='direct' {points} {attributes}"));
        let text = refused.expect_err("nothing");
        assert!(text.contains(reason), "{text}");
    }
    assert!(flexcomp("type='direct' point='0 0 inf' element='0 0 0'").is_err());
}

#[test]
fn what_is_no_block_of_nodes_is_refused() {
    for (attributes, reason) in [
        ("type='circle' count='8 1 1' dim='1'", "without ends"),
        ("type='disc' count='3 3 3'", "two axes"),
        ("type='box' count='3 3 1'", "three axes"),
        ("type='gmsh' file='a.msh'", "type 'gmsh'"),
        ("type='mesh'", "names no file"),
        ("type='mesh' file='a.obj'", "no meshes"),
    ] {
        let text = flexcomp(attributes).expect_err("nothing");
        assert!(text.contains(reason), "{text}");
    }
    let pinned =
        "<flexcomp type='box' count='3 3 3'><edge stiffness='5'/><pin grid='0 0 0'/></flexcomp>";
    let fragment = Fragment::read(pinned).expect("XML");
    assert!(Flex::of_element(&fragment.elements[0], "base").is_err());
}

/// A pyramid over a square, of which each triangle has its own vertices.
struct Pyramid;

impl Files for Pyramid {
    fn include(&mut self, _: &str) -> Result<Vec<u8>, String> {
        Err("there is none".to_owned())
    }

    fn triangles(&mut self, file: &str) -> Result<Triangles, String> {
        assert_eq!(file, "meshes/tip.stl");
        let [a, b, c, d, e] = [
            [0.0; 3],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.5, 0.5, 1.0],
        ];
        let faces = [
            [a, c, b],
            [a, d, c],
            [a, b, e],
            [b, c, e],
            [c, d, e],
            [d, a, e],
        ];
        let vertices: Vec<[f64; 3]> = faces.into_iter().flatten().collect();
        let corners = (0..6).map(|face| [0, 1, 2].map(|corner| 3 * face + corner));
        Ok(Triangles {
            vertices,
            corners: corners.collect(),
        })
    }
}

#[test]
fn meshes_are_sheets_or_fill_with_an_origin() {
    let read = |attributes: &str| {
        let text = format!(
            "<mujoco><compiler meshdir='meshes'/><worldbody><geom size='1'/><body><flexcomp type='mesh' file='tip.stl' {attributes}><edge stiffness='5'/></flexcomp></body></worldbody></mujoco>"
        );
        let parsed = mjcf::read(text.as_bytes(), &mut Pyramid).expect("MJCF");
        let said = parsed.warnings.iter().map(ToString::to_string).collect();
        (parsed.value.flexes, said)
    };
    let (flexes, said): (Vec<Flex>, Vec<String>) = read("scale='2 2 3'");
    assert_eq!(said, [] as [&str; 0]);
    let sheet = &flexes[0];
    assert_eq!(sheet.points.len(), 5);
    are_at(sheet, &[(1, [2.0, 2.0, 0.0]), (4, [1.0, 1.0, 3.0])]);
    let (flexes, _) = read("dim='3' origin='.5 .5 .2' scale='-1 1 1'");
    assert_eq!(flexes[0].points.len(), 6);
    let (flexes, _) = read("dim='3' origin='.5 .5 .2'");
    assert!((volume(&flexes[0]) - 1.0 / 3.0).abs() < 1e-12);
    let (_, said) = read("dim='3'");
    assert!(said[0].contains("needs an origin"), "{said:?}");
}
