//! The names by which pieces of MJCF speak of objects and of nodes.

use robot_description::mjcf::{Flex, FlexForm};

use super::{Result, refused};
use scene::{Handle, Scene};

/// Elements that stand around the bodies, not within one.
const AROUND: &[&str] = &[
    "mujoco",
    "worldbody",
    "world",
    "option",
    "compiler",
    "size",
    "default",
    "asset",
    "contact",
    "deformable",
    "equality",
    "tendon",
    "actuator",
    "sensor",
    "keyframe",
    "custom",
    "extension",
];

/// The object that an element of MuJoCo's model stands for; None: the world, or what is around it.
pub(super) fn object(scene: &Scene, element: &str) -> Result<Option<Handle>> {
    if AROUND.contains(&element) {
        return Ok(None);
    }
    let found = body(scene, element);
    found
        .map(Some)
        .ok_or_else(|| refused(format!("there is no element '{element}'.")))
}

/// The object of a name: as `getInfo` writes it, or an alias that only one has.
pub(super) fn body(scene: &Scene, name: &str) -> Option<Handle> {
    let unique = scene
        .objects()
        .map(scene::Object::handle)
        .find(|handle| scene.unique_alias(*handle).is_ok_and(|alias| alias == name));
    let mut named = scene.objects().filter(|object| object.alias() == name);
    let first = named.next().map(scene::Object::handle);
    unique.or(first.filter(|_| named.next().is_none()))
}

/// The node that a name of a body speaks of: `cloth_3` of a flexcomp, `prefixB_first`, `prefixB_2` and `prefixB_last` of a cable, `prefixB2_4_0` of others. Of a cable also
/// the node behind it, if a place in the body's frame is nearer to it.
pub(super) fn node(flex: &Flex, name: &str, anchor: [f64; 3]) -> Option<usize> {
    let rest = name.strip_prefix(flex.name.as_str())?;
    if let Some(number) = rest.strip_prefix('_') {
        return index(number, flex.points.len());
    }
    let rest = rest.strip_prefix('B')?;
    let bodies = flex.points.len() - 1;
    let is_cable = matches!(flex.form, FlexForm::Line { .. });
    if !is_cable || !rest.starts_with('_') {
        return in_grid(flex, rest);
    }
    let body = match rest {
        "_first" => 0,
        "_last" => bodies - 1,
        other => index(other.strip_prefix('_')?, bodies)?,
    };
    let [here, next] = [body, body + 1].map(|node| nalgebra::Vector3::from(flex.points[node]));
    let is_beyond = nalgebra::Vector3::from(anchor).norm() > 0.5 * (next - here).norm();
    Some(body + usize::from(is_beyond))
}

fn index(text: &str, count: usize) -> Option<usize> {
    text.parse().ok().filter(|index| *index < count)
}

fn in_grid(flex: &Flex, text: &str) -> Option<usize> {
    let mut place = [0; 3];
    let mut words = text.split('_');
    for (number, count) in place.iter_mut().zip(flex.count) {
        match words.next() {
            Some(word) => *number = index(word, count)?,
            None => break,
        }
    }
    let [i, j, k] = place;
    let number = (i * flex.count[1] + j) * flex.count[2] + k;
    words.next().is_none().then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flex(count: [usize; 3], form: FlexForm) -> Flex {
        let points = (0..count.iter().product::<usize>()).map(|i| [0.1 * i as f64, 0.0, 0.0]);
        Flex {
            name: "k".into(),
            points: points.collect(),
            count,
            form,
            ..Flex::default()
        }
    }

    #[test]
    fn nodes_of_flexcomps_have_numbers() {
        let sheet = flex([3, 3, 1], FlexForm::default());
        for (name, expected) in [
            ("k_8", Some(8)),
            ("k_9", None),
            ("k8", None),
            ("l_8", None),
            ("k_", None),
        ] {
            assert_eq!(node(&sheet, name, [0.0; 3]), expected, "{name}");
        }
    }

    #[test]
    fn bodies_of_cables_are_between_nodes() {
        let cable = flex([5, 1, 1], FlexForm::default());
        for (name, x, expected) in [
            ("kB_first", 0.0, Some(0)),
            ("kB_2", 0.0, Some(2)),
            ("kB_last", 0.0, Some(3)),
            ("kB_last", 0.1, Some(4)),
            ("kB_4", 0.0, None),
            ("kB3", 0.0, Some(3)),
        ] {
            assert_eq!(node(&cable, name, [x, 0.0, 0.0]), expected, "{name} {x}");
        }
    }

    #[test]
    fn bodies_of_grids_have_places() {
        let solid = FlexForm::Solid {
            triangles: Vec::new(),
            tetrahedra: Vec::new(),
            young: 1.0,
            poisson: 0.0,
        };
        let solid = flex([3, 4, 5], solid);
        for (name, expected) in [
            ("kB2_3_4", Some(59)),
            ("kB1_2", Some(30)),
            ("kB3_0_0", None),
            ("kB0_0_0_0", None),
        ] {
            assert_eq!(node(&solid, name, [0.0; 3]), expected, "{name}");
        }
    }
}
