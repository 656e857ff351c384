//! What acts on bodies of MJCF by their surface, and what compensates their weight: MuJoCo's parameters of their shapes.

use std::collections::BTreeMap;

use robot_description::mjcf::Adhesion;
use scene::shape::{ContactPair, MovingSurface, SURFACE};
use scene::{Data, Field, Handle, SceneResult, ValueType};

use super::Import;

impl Import<'_> {
    /// Sets the parameters of the shape of a link, which count with any engine then.
    pub(super) fn set_surface(&mut self, link: usize, shape: Handle) -> SceneResult<()> {
        let model = self.model;
        let adhesion = model
            .adhesions
            .iter()
            .find(|adhesion| adhesion.link == link);
        let compensation = of_link(&model.compensations, link);
        let motion = of_link(&model.moving_surfaces, link);
        if adhesion.is_none() && compensation.is_none() && motion.is_none() {
            return Ok(());
        }
        let values = values(adhesion, compensation);
        self.scene.try_modify(shape, Field::Dynamics, |object| {
            let material = &mut object.shape_mut()?.material;
            for (name, value) in values {
                material.engine_values.set(name, value);
            }
            Ok(())
        })?;
        let motion = motion.map(|motion| self.in_shape(motion, link, shape));
        let text = motion
            .transpose()?
            .map_or_else(String::new, |motion| motion.to_string());
        self.set_custom_data(shape, SURFACE, (ValueType::String, Data::text(&text)))
    }

    /// Lets shapes say with what friction they touch others; those that became no shape say nothing.
    pub(super) fn set_pair_frictions(&mut self) -> SceneResult<()> {
        let mut rules: BTreeMap<Handle, Vec<ContactPair>> = BTreeMap::new();
        for (links, friction) in &self.model.pair_frictions {
            let [shape, other] = links.map(|link| self.nodes[link].carrier);
            if let (Some(shape), Some(other)) = (shape, other) {
                rules.entry(shape).or_default().push(ContactPair {
                    other,
                    touches: true,
                    friction: Some(*friction),
                });
            }
        }
        for (shape, pairs) in rules {
            self.scene.set_contact_pairs(shape, &pairs)?;
        }
        Ok(())
    }

    /// A motion in the frame of a link, in that of its shape.
    fn in_shape(
        &self,
        motion: MovingSurface,
        link: usize,
        shape: Handle,
    ) -> SceneResult<MovingSurface> {
        let relative = self.scene.world_pose(shape)?.inverse() * self.placed[link];
        Ok(motion.seen_from(&relative))
    }
}

fn of_link<T: Copy>(all: &[(usize, T)], link: usize) -> Option<T> {
    let mut all = all.iter();
    all.find(|(of, _)| *of == link).map(|(_, value)| *value)
}

/// MuJoCo's parameters of a shape that adheres, and of one of whose weight a part is compensated.
pub fn values(adhesion: Option<&Adhesion>, compensation: Option<f64>) -> Vec<(&'static str, Data)> {
    let mut values = Vec::new();
    values.extend(compensation.map(|part| ("mujoco.gravcomp", Data::Float(part))));
    if let Some(adhesion) = adhesion {
        values.push(("mujoco.adhesion", Data::Bool(true)));
        values.push(("mujoco.adhesiongain", Data::Float(adhesion.gain)));
        let ranges = [
            ("mujoco.adhesionctrlrange", adhesion.control),
            ("mujoco.adhesionforcerange", adhesion.force),
        ];
        for (name, range) in ranges {
            values.extend(range.map(|range| (name, Data::from(range.to_vec()))));
        }
        let is_limited = i64::from(adhesion.force.is_some());
        values.push(("mujoco.adhesionforcelimited", Data::Int(is_limited)));
    }
    values
}
