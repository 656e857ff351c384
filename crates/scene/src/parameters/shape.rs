//! The numbered parameters of shapes (`sim.shapeintparam_*`, `sim.shapefloatparam_*`).

use geometry::pose::euler::{rotation_from_euler, rotation_to_euler};

use crate::appearance::texture_mapping::TextureMapping;
use crate::shape::{Appearance, RespondableMask, Shape};

impl Shape {
    fn first_appearance(&self) -> Option<&Appearance> {
        self.parts.first().map(|part| &part.appearance)
    }

    fn each_appearance(&mut self, change: impl FnMut(&mut Appearance)) {
        self.parts
            .iter_mut()
            .map(|part| &mut part.appearance)
            .for_each(change);
    }

    fn first_texture(&self) -> Option<&TextureMapping> {
        self.parts.first()?.texture.as_deref()
    }

    fn each_texture(&mut self, change: impl FnMut(&mut TextureMapping)) {
        self.parts
            .iter_mut()
            .filter_map(|part| part.texture.as_deref_mut())
            .for_each(change);
    }

    /// The value of an integer parameter; None when shapes have no such parameter.
    pub fn int_param(&self, id: i64) -> Option<i64> {
        let dynamics = &self.dynamics;
        let seen = |is: fn(&Appearance) -> bool| i64::from(self.first_appearance().is_some_and(is));
        Some(match id {
            3003 => i64::from(dynamics.is_static),
            3004 => i64::from(dynamics.respondable),
            3014 => seen(|a| a.culling),
            3015 => seen(|a| a.wireframe),
            3016 => i64::from(self.is_compound()),
            3017 | 3018 => i64::from(self.is_convex()),
            3019 => dynamics.respondable_mask.0,
            3024 => seen(|a| a.edges),
            3027 => seen(|a| a.edge_borders_hidden),
            3028 => self.parts.len() as i64,
            3029 => i64::from(dynamics.start_asleep),
            3030 => i64::from(dynamics.kinematic),
            3031 => dynamics.respondable_suspend_count,
            _ => return None,
        })
    }

    /// Sets an integer parameter; false when shapes have no such parameter, or only one to read.
    pub fn set_int_param(&mut self, id: i64, value: i64) -> bool {
        let on = value != 0;
        match id {
            3003 => self.dynamics.is_static = on,
            3004 => self.dynamics.respondable = on,
            3014 => self.each_appearance(|a| a.culling = on),
            3015 => self.each_appearance(|a| a.wireframe = on),
            3019 => self.dynamics.respondable_mask = RespondableMask(value),
            3024 => self.each_appearance(|a| a.edges = on),
            3027 => self.each_appearance(|a| a.edge_borders_hidden = on),
            3029 => self.dynamics.start_asleep = on,
            3030 => self.dynamics.kinematic = on,
            3031 => self.dynamics.respondable_suspend_count = value.max(0),
            _ => return false,
        }
        true
    }

    /// The value of a float parameter (SI units); None when shapes have no such parameter.
    pub fn float_param(&self, id: i64) -> Option<f64> {
        let initial = &self.dynamics.initial_velocity;
        let angle = |of: fn(&Appearance) -> f64| self.first_appearance().map_or(0.0, of);
        Some(match id {
            3000..=3002 => initial.linear[(id - 3000) as usize],
            3005 => self.mass.mass,
            3006..=3013 => self
                .first_texture()
                .map_or(0.0, |texture| texture.param(id)),
            3020..=3022 => initial.angular[(id - 3020) as usize],
            3025 => angle(|a| a.shading_angle),
            3026 => angle(|a| a.edge_angle),
            _ => return None,
        })
    }

    /// Sets a float parameter; false when shapes have no such parameter. NaN is ignored.
    pub fn set_float_param(&mut self, id: i64, value: f64) -> bool {
        if value.is_nan() {
            return self.float_param(id).is_some();
        }
        let initial = &mut self.dynamics.initial_velocity;
        match id {
            3000..=3002 => initial.linear[(id - 3000) as usize] = value,
            3005 => self.mass.set_mass(value),
            3006..=3013 => self.each_texture(|texture| texture.set_param(id, value)),
            3020..=3022 => initial.angular[(id - 3020) as usize] = value,
            3025 => self.each_appearance(|a| a.shading_angle = value),
            3026 => self.each_appearance(|a| a.edge_angle = value),
            _ => return false,
        }
        true
    }
}

impl TextureMapping {
    /// Where the image is projected from: x, y, z, then Euler angles; then its size.
    fn param(&self, id: i64) -> f64 {
        match id {
            3006..=3008 => self.frame.translation.vector[(id - 3006) as usize],
            3009..=3011 => rotation_to_euler(&self.frame.rotation)[(id - 3009) as usize],
            3012 => self.scale[0],
            _ => self.scale[1],
        }
    }

    /// Infinite values are ignored.
    fn set_param(&mut self, id: i64, value: f64) {
        match id {
            _ if !value.is_finite() => {}
            3006..=3008 => self.frame.translation.vector[(id - 3006) as usize] = value,
            3009..=3011 => {
                let mut angles = rotation_to_euler(&self.frame.rotation);
                angles[(id - 3009) as usize] = value;
                self.frame.rotation = rotation_from_euler(&angles);
            }
            3012 => self.scale[0] = value,
            _ => self.scale[1] = value,
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::shape::Shape;
    use geometry::PrimitiveKind;

    #[test]
    fn the_mask_is_kept_as_written() {
        let mut shape =
            Shape::primitive(PrimitiveKind::Cuboid, [1.0; 3], Default::default()).unwrap();
        assert!(shape.set_int_param(3019, 0x12345));
        assert_eq!(shape.int_param(3019), Some(0x12345));
        assert_eq!(
            (shape.int_param(3003), shape.int_param(3999)),
            (Some(1), None)
        );
    }
}
