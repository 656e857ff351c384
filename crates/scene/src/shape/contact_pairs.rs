//! Pairs of shapes that touch, or do not, whatever their masks say: what `<contact>` of MJCF says.

use std::fmt::Write as _;

use crate::{
    Data, Edit, Field, Handle, Namespace, Object, References, Scene, SceneResult, ValueType,
};

/// Name of the custom data of a shape that say how it touches others, and of the references to those: see [`ContactPair`].
pub const PAIRS: &str = "mjcfPairs";

/// How a shape touches another one. As text, a line each: `shape=0 touches=0`, `shape=1 touches=1 friction=0.5`; the shape is one of the references.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPair {
    /// The other shape.
    pub other: Handle,
    /// Whether they touch.
    pub touches: bool,
    /// Coefficient of friction of both together; None for that of their materials.
    pub friction: Option<f64>,
}

impl Object {
    /// With which shapes this one has a rule of their own; those that are gone are left out.
    pub fn contact_pairs(&self) -> Vec<ContactPair> {
        let text = match self.custom_data.typed(PAIRS) {
            Some((_, Data::Text(text) | Data::Buffer(text))) => String::from_utf8_lossy(text),
            _ => return Vec::new(),
        };
        let others = self.referenced(References::Following, PAIRS);
        text.lines().filter_map(|line| pair(line, others)).collect()
    }
}

fn pair(line: &str, others: &[i64]) -> Option<ContactPair> {
    let words = line
        .split_whitespace()
        .filter_map(|word| word.split_once('='));
    let (mut other, mut touches, mut friction) = (None, true, None);
    for (name, value) in words {
        match name {
            "shape" => {
                let raw = *others.get(value.parse::<usize>().ok()?)?;
                other = Handle::from_raw(raw).filter(|_| raw >= 0);
            }
            "touches" => touches = value != "0",
            "friction" => friction = value.parse().ok().filter(is_coefficient),
            _ => {}
        }
    }
    Some(ContactPair {
        other: other?,
        touches,
        friction,
    })
}

fn is_coefficient(friction: &f64) -> bool {
    friction.is_finite() && *friction >= 0.0
}

impl Scene {
    /// Says how a shape touches others.
    ///
    /// # Errors
    /// When there is no such object.
    pub fn set_contact_pairs(&mut self, shape: Handle, pairs: &[ContactPair]) -> SceneResult<()> {
        let (mut text, mut others) = (String::new(), Vec::new());
        for pair in pairs {
            let _ = write!(
                text,
                "shape={} touches={}",
                others.len(),
                u8::from(pair.touches)
            );
            if let Some(friction) = pair.friction {
                let _ = write!(text, " friction={friction}");
            }
            text.push('\n');
            others.push(pair.other.raw());
        }
        self.set_references(shape, References::Following, PAIRS, &others)?;
        let value = (!text.is_empty()).then(|| (ValueType::String, Data::text(&text)));
        self.edit_named_values(Some(shape), Namespace::CustomData, Edit::Name(PAIRS, value))?;
        self.modify(shape, Field::Dynamics, |_| ())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kind;
    use crate::object::dummy::Dummy;

    #[test]
    fn pairs_are_what_was_said_as_long_as_both_are_there() {
        let mut scene = Scene::new();
        let mut add = || {
            scene
                .add("body", Kind::Dummy(Dummy::new(0.1)))
                .expect("room")
        };
        let [one, two, three] = [add(), add(), add()];
        let pairs = [
            ContactPair {
                other: two,
                touches: false,
                friction: None,
            },
            ContactPair {
                other: three,
                touches: true,
                friction: Some(0.25),
            },
        ];
        scene.set_contact_pairs(one, &pairs).expect("exists");
        let read = |scene: &Scene| scene.object(one).expect("exists").contact_pairs();
        assert_eq!(read(&scene), pairs);
        scene.remove(&[two]).expect("exists");
        assert_eq!(read(&scene), pairs[1..]);
        scene.set_contact_pairs(one, &[]).expect("exists");
        assert_eq!(read(&scene), []);
        let custom = &scene.object(one).expect("exists").custom_data;
        assert_eq!(custom.typed(PAIRS), None);
    }

    #[test]
    fn numbers_that_mean_nothing_are_left_out() {
        assert_eq!(pair("shape=3", &[5]), None);
        assert_eq!(pair("friction=1", &[5]), None);
        let pair = pair("shape=0 friction=-1 odd", &[5]).expect("a shape");
        assert_eq!((pair.touches, pair.friction), (true, None));
    }
}
