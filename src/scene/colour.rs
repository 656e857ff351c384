//! Colours of objects, as scripts read and write them (SPEC-shapes section 8). Nothing is drawn.

use super::shape::{Appearance, Shape};
use super::{Field, Handle, Kind, Scene, SceneError, SceneResult};

/// A part of a colour (`sim.colorcomponent_*`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Component {
    AmbientDiffuse,
    Specular,
    Emission,
    /// One number, 1 for opaque.
    Transparency,
    Auxiliary,
}

/// Which meshes of a shape are meant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ColourName {
    All,
    /// One value per mesh, in order.
    Compound,
    Named(String),
}

impl Component {
    /// The component with a script's number, if there is one.
    pub fn from_code(code: i64) -> Option<Self> {
        Some(match code {
            0 | 1 => Self::AmbientDiffuse,
            2 => Self::Specular,
            3 => Self::Emission,
            4 => Self::Transparency,
            5 => Self::Auxiliary,
            _ => return None,
        })
    }

    /// How many numbers make up a value.
    pub fn width(self) -> usize {
        if self == Self::Transparency { 1 } else { 3 }
    }
}

impl ColourName {
    /// What a script means by `name`.
    pub fn from_script(name: Option<String>) -> Self {
        match name {
            None => Self::All,
            Some(name) if name == "@compound" => Self::Compound,
            Some(name) => Self::Named(name),
        }
    }

    fn covers(&self, appearance: &Appearance) -> bool {
        !matches!(self, Self::Named(name) if *name != appearance.colour_name)
    }
}

impl Appearance {
    fn slot(&mut self, component: Component) -> &mut [f32] {
        match component {
            Component::AmbientDiffuse => &mut self.ambient_diffuse,
            Component::Specular => &mut self.specular,
            Component::Emission => &mut self.emission,
            Component::Auxiliary => &mut self.auxiliary,
            Component::Transparency => std::slice::from_mut(&mut self.opacity),
        }
    }

    /// The numbers of one component.
    pub fn colour(&self, component: Component) -> &[f32] {
        match component {
            Component::AmbientDiffuse => &self.ambient_diffuse,
            Component::Specular => &self.specular,
            Component::Emission => &self.emission,
            Component::Auxiliary => &self.auxiliary,
            Component::Transparency => std::slice::from_ref(&self.opacity),
        }
    }

    /// Sets one component; longer values are cut.
    fn set_colour(&mut self, component: Component, value: &[f64]) {
        write(self.slot(component), value);
    }
}

fn write(slot: &mut [f32], value: &[f64]) {
    slot.iter_mut().zip(value).for_each(|(number, new)| *number = *new as f32);
}

fn read(slot: &[f32]) -> Vec<f64> {
    slot.iter().map(|&number| number.into()).collect()
}

impl Shape {
    /// The colour of the first mesh called so, or of every mesh; None when there is none.
    pub fn colour(&self, name: &ColourName, component: Component) -> Option<Vec<f64>> {
        let mut colours = self.parts.iter().map(|part| &part.appearance).filter(|a| name.covers(a));
        match name {
            ColourName::Compound => Some(colours.flat_map(|a| read(a.colour(component))).collect()),
            _ => colours.next().map(|a| read(a.colour(component))),
        }
    }

    /// Colours the meshes called so, or every mesh with its own value.
    ///
    /// # Errors
    /// When `value` has too few numbers; nothing is changed then.
    fn set_colour(&mut self, name: &ColourName, component: Component, value: &[f64]) -> SceneResult<()> {
        let width = component.width();
        let each = if *name == ColourName::Compound { width } else { 0 };
        let needed = if each == 0 { width } else { width * self.parts.len() };
        if value.len() < needed {
            return Err(SceneError::InvalidArgument);
        }
        for (i, part) in self.parts.iter_mut().enumerate().filter(|(_, part)| name.covers(&part.appearance)) {
            part.appearance.set_colour(component, &value[i * each..]);
        }
        Ok(())
    }
}

impl Scene {
    /// Colours meshes of a shape.
    ///
    /// # Errors
    /// When `value` has too few numbers.
    pub fn set_shape_colour(
        &mut self,
        handle: Handle,
        name: &ColourName,
        component: Component,
        value: &[f64],
    ) -> SceneResult<()> {
        self.try_modify(handle, Field::Appearance, |object| object.shape_mut()?.set_colour(name, component, value))
    }

    /// A colour of any object; None when it has no such one. Shapes have one per mesh, `index` tells which.
    pub fn object_colour(&self, handle: Handle, index: usize, component: Component) -> SceneResult<Option<Vec<f64>>> {
        Ok(match &self.object(handle)?.kind {
            Kind::Shape(shape) => shape.parts.get(index).map(|part| read(part.appearance.colour(component))),
            Kind::Dummy(dummy) if component == Component::AmbientDiffuse => Some(read(&dummy.colour)),
            Kind::Light(light) if component == Component::AmbientDiffuse => Some(read(&light.diffuse)),
            Kind::Light(light) if component == Component::Specular => Some(read(&light.specular)),
            _ => None,
        })
    }

    /// Sets a colour of any object; false when it has no such one.
    pub fn set_object_colour(
        &mut self,
        handle: Handle,
        index: usize,
        component: Component,
        value: &[f64],
    ) -> SceneResult<bool> {
        if self.object_colour(handle, index, component)?.is_none() {
            return Ok(false);
        }
        self.modify(handle, Field::Appearance, |object| match &mut object.kind {
            Kind::Shape(shape) => shape.parts[index].appearance.set_colour(component, value),
            Kind::Dummy(dummy) => write(&mut dummy.colour, value),
            Kind::Light(light) if component == Component::Specular => write(&mut light.specular, value),
            Kind::Light(light) => write(&mut light.diffuse, value),
            _ => {}
        })?;
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::primitive::PrimitiveKind;

    #[test]
    fn colours_are_kept_in_32_bits_and_not_limited() {
        let mut shape = Shape::primitive(PrimitiveKind::Cuboid, [1.0; 3], Default::default()).unwrap();
        shape.set_colour(&ColourName::All, Component::AmbientDiffuse, &[2.0, -1.0, 0.2]).unwrap();
        let colour = shape.colour(&ColourName::Named(String::new()), Component::AmbientDiffuse);
        assert_eq!(colour, Some(vec![2.0, -1.0, f64::from(0.2f32)]));
        assert_eq!(shape.colour(&ColourName::Named("nope".into()), Component::AmbientDiffuse), None);
    }
}
