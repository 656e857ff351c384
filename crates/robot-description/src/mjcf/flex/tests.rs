//! What is read of soft things, beside what MuJoCo makes of the same text.

use super::*;
use crate::mjcf::Fragment;

fn read(text: &str) -> Result<Flex, String> {
    read_on(text, "base")
}

fn read_on(text: &str, body: &str) -> Result<Flex, String> {
    let fragment = Fragment::read(text).map_err(|error| error.to_string())?;
    Flex::of_element(&fragment.elements[0], body).map(|(flex, _)| flex)
}

fn flexcomp(attributes: &str, inside: &str) -> Result<Flex, String> {
    read(&format!("<flexcomp {attributes}>{inside}</flexcomp>"))
}

fn composite(attributes: &str, inside: &str) -> Flex {
    read(&format!(
        "<composite prefix='k' {attributes}>{inside}</composite>"
    ))
    .expect("it is soft")
}

fn pinned(flex: &Flex) -> Vec<usize> {
    flex.pins.iter().map(|pin| pin.node).collect()
}

fn volume(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> f64 {
    let corner = |index: u32| nalgebra::Vector3::from(points[index as usize]);
    let of_one = |[a, b, c]: &[u32; 3]| corner(*a).dot(&corner(*b).cross(&corner(*c))) / 6.0;
    triangles.iter().map(of_one).sum()
}

#[test]
fn nodes_have_the_order_of_mujoco() {
    let flex = flexcomp(
        "name='c' count='3 4 1' spacing='.1 .2 .3' pos='0 0 1'",
        "<edge stiffness='5'/>",
    )
    .expect("it is a sheet");
    assert_eq!((flex.points.len(), flex.count), (12, [3, 4, 1]));
    for (node, expected) in [
        (0, [-0.1, -0.3, 1.0]),
        (1, [-0.1, -0.1, 1.0]),
        (4, [0.0, -0.3, 1.0]),
    ] {
        let error = (0..3)
            .map(|i| (flex.points[node][i] - expected[i]).abs())
            .sum::<f64>();
        assert!(error < 1e-12, "{node}: {:?}", flex.points[node]);
    }
    let FlexForm::Sheet {
        triangles, stretch, ..
    } = &flex.form
    else {
        panic!("it is no sheet: {flex:?}");
    };
    assert_eq!((triangles.len(), *stretch), (12, 7.5));
    let area: f64 = triangles
        .iter()
        .map(|[a, b, c]| {
            let [a, b, c] =
                [a, b, c].map(|index| nalgebra::Vector3::from(flex.points[*index as usize]));
            (b - a).cross(&(c - a)).z / 2.0
        })
        .sum();
    assert!((area - 0.2 * 0.6).abs() < 1e-12, "{area}");
}

#[test]
fn tetrahedra_fill_the_box_and_face_outwards() {
    let flex = flexcomp(
        "count='3 2 4' spacing='.1 .2 .3'",
        "<elasticity young='1e4' poisson='0.3' damping='0.01'/>",
    )
    .expect("it is a solid");
    let FlexForm::Solid {
        triangles,
        tetrahedra,
        young,
        poisson,
    } = &flex.form
    else {
        panic!("it is no solid: {flex:?}");
    };
    assert_eq!(
        (tetrahedra.len(), *young, *poisson, flex.damping),
        (36, 1e4, 0.3, 0.01)
    );
    let corner = |index: u32| nalgebra::Vector3::from(flex.points[index as usize]);
    let each = tetrahedra.iter().map(|[a, b, c, d]| {
        let [b, c, d] = [b, c, d].map(|index| corner(*index) - corner(*a));
        b.cross(&c).dot(&d) / 6.0
    });
    assert!(each.clone().all(|volume| volume > 0.0));
    let whole = 0.2 * 0.2 * 0.9;
    assert!((each.sum::<f64>() - whole).abs() < 1e-12);
    assert!((volume(&flex.points, triangles) - whole).abs() < 1e-12);
}

#[test]
fn constraints_are_as_firm_as_mujoco_has_them() {
    let flex =
        flexcomp("count='2 2 1' mass='4'", "<edge equality='true'/>").expect("it is a sheet");
    let FlexForm::Sheet { stretch, .. } = flex.form else {
        panic!("it is no sheet: {flex:?}");
    };
    // A kilogram, 1 / (0.95 * 0.02)^2, impedance 0.95; a lattice with diagonals.
    let expected = 1.5 * 0.95 / (0.95_f64 * 0.02).powi(2) * 19.0;
    assert!((stretch - expected).abs() < 1e-6, "{stretch}");
    assert!((flex.damping - 2.0 * 0.02).abs() < 1e-9, "{}", flex.damping);
}

#[test]
fn sheets_of_a_material_stretch_and_bend() {
    let shell = "<elasticity young='3e6' poisson='0' thickness='0.01' elastic2d='both'/>";
    let flex = flexcomp("count='4 4 1'", shell).expect("it is a sheet");
    let FlexForm::Sheet { stretch, bend, .. } = flex.form else {
        panic!("it is no sheet: {flex:?}");
    };
    assert!(
        (stretch - 3e4).abs() < 1e-6 && (bend - 0.25).abs() < 1e-9,
        "{stretch} {bend}"
    );
    let old = "<edge equality='true'/><plugin plugin='mujoco.elasticity.shell'><config key='young' value='3e6'/><config key='thickness' value='0.01'/></plugin>";
    let flex = flexcomp("count='4 4 1'", old).expect("it is a sheet");
    assert!(matches!(flex.form, FlexForm::Sheet { bend, .. } if (bend - 0.25).abs() < 1e-9));
}

#[test]
fn pins_are_numbers_ranges_and_places() {
    let pins =
        "<edge stiffness='1'/><pin id='0 3' range='5 6'/><pin grid='2 1' gridrange='3 0 3 1'/>";
    let flex = flexcomp("count='4 2 1'", pins).expect("it is a sheet");
    assert_eq!(pinned(&flex), [0, 3, 5, 6, 7]);
    let wrong = flexcomp("count='4 2 1'", "<edge stiffness='1'/><pin id='8'/>");
    assert_eq!(wrong, Err("it has no node 8 that could be pinned".into()));
    let rigid =
        flexcomp("count='4 2 1' rigid='true'", "<edge stiffness='1'/>").expect("it is a sheet");
    assert_eq!(rigid.pins.len(), 8);
}

#[test]
fn what_describes_nothing_soft_is_refused() {
    for (attributes, inside, reason) in [
        ("type='gmsh'", "", "flexcomps of type 'gmsh' are not read"),
        (
            "count='3 3 1'",
            "",
            "it has neither edges nor elasticity that hold its nodes together",
        ),
        (
            "count='1 1 1'",
            "<edge stiffness='1'/>",
            "its count, [1, 1, 1], does not have dimension 0",
        ),
        (
            "count='3 3 3' dim='2'",
            "<edge stiffness='1'/>",
            "its count, [3, 3, 3], does not have dimension 2",
        ),
        (
            "count='3 0 1'",
            "",
            "its count is not made of whole numbers from 1 to 10000",
        ),
        (
            "count='2.5 2 1'",
            "",
            "its count is not made of whole numbers from 1 to 10000",
        ),
        (
            "count='9000 9000 9000'",
            "",
            "it has 729000000000 nodes, more than 50000",
        ),
        ("count='3001 1 1'", "", "it has 3001 nodes, more than 2000"),
        ("count='3 3 1' mass='-1'", "", "its mass is not positive"),
        ("count='3 3 1' radius='0'", "", "its radius is not positive"),
        (
            "count='3 3 1' spacing='0.1 -1 1'",
            "",
            "its spacing, -1, is not from 0.000001 to below 1000",
        ),
        (
            "count='3 3 1'",
            "<elasticity young='1' poisson='0.5'/>",
            "its poisson, 0.5, is not from 0 to below 0.4999",
        ),
    ] {
        assert_eq!(
            flexcomp(attributes, inside),
            Err(reason.into()),
            "{attributes} {inside}"
        );
    }
}

#[test]
fn a_cable_has_the_stiffness_of_its_material() {
    let inside = "<joint kind='main' damping='0.001'/><geom type='capsule' size='.01' density='2000'/>
        <plugin plugin='mujoco.elasticity.cable'><config key='twist' value='1e7'/><config key='bend' value='4e6'/><config key='flat' value='true'/></plugin>";
    let flex = composite(
        "type='cable' curve='s' count='5 1 1' size='1' offset='0 0 3'",
        inside,
    );
    assert_eq!((flex.name.as_str(), flex.points[4]), ("k", [1.0, 0.0, 3.0]));
    assert_eq!(
        flex.pins,
        [FlexPin {
            node: 0,
            clamped: true
        }]
    );
    let moment = 0.25 * std::f64::consts::PI * 1e-8;
    let FlexForm::Line {
        bend,
        twist,
        straight,
        ..
    } = flex.form
    else {
        panic!("it is no line: {flex:?}");
    };
    assert!(
        (bend / (4e6 * moment) - 1.0).abs() < 1e-9 && (twist / (2e7 * moment) - 1.0).abs() < 1e-9
    );
    assert!(straight);
    assert!((flex.damping - 0.001 * 0.25 / bend).abs() < 1e-9);
    // As MuJoCo weighs the four capsules.
    assert!(
        (flex.mass - 2.0 * 4.0 * 0.0827).abs() < 1e-3,
        "{}",
        flex.mass
    );
}

#[test]
fn cables_follow_curves_and_begin_in_three_ways() {
    let inside = "<geom type='box' size='1 .01 .02'/>";
    let helix = composite(
        "type='cable' curve='cos(s) sin(s) s' count='5 1 1' size='1 2 1' initial='ball'",
        inside,
    );
    let quarter = helix.points[1];
    assert!(quarter[0].abs() < 1e-9 && (quarter[1] - 2.0).abs() < 1e-9 && quarter[2] == 0.25);
    assert_eq!(
        helix.pins,
        [FlexPin {
            node: 0,
            clamped: false
        }]
    );
    assert_eq!(
        composite("type='cable' count='5 1 1' initial='free'", inside).pins,
        []
    );
    let listed = composite("type='cable' vertex='0 0 0 0 0 1 0 1 1'", inside);
    assert_eq!(listed.points[2], [0.0, 1.0, 1.0]);
    let long: String = (0..2000).map(|i| format!("0 0 {i} ")).collect();
    let long = composite(&format!("type='cable' vertex='{long}'"), inside);
    assert_eq!(long.points.len(), 2000);
}

#[test]
fn old_ropes_and_cloths_contain_the_link() {
    let inside = "<joint kind='main' damping='0.005'/><geom type='capsule' size='.01 .015'/>";
    let text = format!("<composite type='rope' count='21 1 1' spacing='0.04'>{inside}</composite>");
    let rope = read_on(&text, "B5").expect("it is a rope");
    assert_eq!((pinned(&rope), rope.points[5]), (vec![5], [0.0; 3]));
    assert_eq!(pinned(&read(&text).expect("it is a rope")), [10]);
    let cloth =
        format!("<composite type='cloth' count='9 7 1' spacing='0.05'>{inside}</composite>");
    let cloth = read_on(&cloth, "B4_2").expect("it is a cloth");
    assert_eq!(
        (pinned(&cloth), cloth.points[4 * 7 + 2]),
        (vec![30], [0.0; 3])
    );
}

#[test]
fn old_grids_are_pinned_by_places() {
    let inside =
        "<joint kind='main' damping='0.1'/><geom size='.02' mass='0.01'/><pin coord='1 0'/>";
    let flex = composite("type='grid' count='3 4 1' spacing='0.1'", inside);
    assert_eq!(pinned(&flex), [4]);
    assert!((flex.mass - 0.12).abs() < 1e-12 && (flex.drag - 10.0).abs() < 1e-9);
}

#[test]
fn old_solids_have_their_nodes_at_the_surface() {
    let inside = "<geom type='sphere' size='.02' mass='0.01'/>";
    for (shape, corner) in [
        ("box", 1.0),
        ("cylinder", 0.5_f64.sqrt()),
        ("ellipsoid", (1.0_f64 / 3.0).sqrt()),
    ] {
        let flex = composite(
            &format!("type='{shape}' count='5 5 5' spacing='0.1'"),
            inside,
        );
        assert_eq!((flex.points.len(), flex.nodes.len()), (125, 98));
        assert_eq!(pinned(&flex), [62]);
        assert!(
            (flex.points[124][0] - 0.2 * corner).abs() < 1e-12,
            "{shape}: {:?}",
            flex.points[124]
        );
        assert!((flex.mass - 0.98).abs() < 1e-9);
    }
    let refused =
        read("<composite type='box' count='2 3 3' spacing='1'><geom size='.1'/></composite>");
    assert_eq!(
        refused,
        Err("its count is not at least 3 along each axis".into())
    );
}

#[test]
fn attributes_are_only_attributes() {
    let element =
        Fragment::element("flexcomp", "dim='2' rgba='1 0 0 1'").expect("they are attributes");
    assert_eq!(element.attribute("dim"), Some("2"));
    for text in [
        "a='1'/><b",
        "a='1'><b/></flexcomp><flexcomp",
        "a",
        "<",
        "a='1' a='2'",
    ] {
        assert!(Fragment::element("flexcomp", text).is_err(), "{text}");
    }
}

#[test]
fn files_name_soft_things_in_bodies() {
    let text =
        b"<mujoco><worldbody><body name='a' pos='0 0 1'><geom size='0.1'/><frame pos='0 1 0'>
        <flexcomp name='c' count='3 3 1'><edge equality='true'/></flexcomp></frame>
        <composite type='loop' count='3 1 1'/></body></worldbody></mujoco>";
    struct None;
    impl crate::mjcf::Files for None {
        fn include(&mut self, _: &str) -> Result<Vec<u8>, String> {
            Err("there is none".into())
        }
        fn triangles(&mut self, _: &str) -> Result<crate::mjcf::Triangles, String> {
            Err("there is none".into())
        }
    }
    let parsed = crate::mjcf::read(text, &mut None).expect("it is a model");
    let [flex] = &parsed.value.flexes[..] else {
        panic!("there is one: {:?}", parsed.value.flexes);
    };
    assert_eq!(
        (flex.name.as_str(), flex.link, flex.points[4]),
        ("c", 1, [0.0, 1.0, 0.0])
    );
    let said: Vec<String> = parsed.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(
        said,
        [
            "line 3, <composite>: a loop is a line of nodes without ends, which ropes have: it is not read"
        ]
    );
}
