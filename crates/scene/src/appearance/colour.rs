//! Colours of objects, as scripts read and write them (spec: shapes 8).

use crate::shape::{Appearance, Shape};
use crate::{Field, Handle, Kind, Object, Scene, SceneError, SceneResult};

/// The colour of a surface or a light: red, green, blue of each component, usually 0 to 1. Single precision, as in scene files; values are not clamped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Colour {
    /// Reflected ambient and diffuse light.
    pub ambient_diffuse: [f32; 3],
    /// Highlights.
    pub specular: [f32; 3],
    /// Light that the surface emits itself.
    pub emission: [f32; 3],
    /// Three values for other purposes: vision sensors can render them instead of the colour.
    pub auxiliary: [f32; 3],
    /// 1 is opaque.
    pub opacity: f32,
}

/// Which colour of an object is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColourSlot {
    /// Of everything but shapes.
    Body,
    /// The second one: emitted light, the ray of a proximity sensor, the other part of a joint or force sensor.
    Second,
    /// Of one mesh of a shape.
    Mesh(usize),
}

/// A part of a colour (`sim.colorcomponent_*`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColourComponent {
    /// Reflected ambient and diffuse light.
    AmbientDiffuse,
    /// From before ambient and diffuse light were one: black, and not kept.
    Diffuse,
    /// Highlights.
    Specular,
    /// Emitted light.
    Emission,
    /// One number, 1 for opaque.
    Transparency,
    /// The auxiliary values.
    Auxiliary,
}

/// Which meshes of a shape are meant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ColourName {
    /// All meshes; the last one is read, as of compounds in CoppeliaSim.
    All,
    /// One value per mesh, in order.
    Compound,
    /// The meshes with that colour name.
    Named(String),
}

impl ColourComponent {
    /// The component with a script's number, if there is one.
    pub fn from_code(code: i64) -> Option<Self> {
        Some(match code {
            0 => Self::AmbientDiffuse,
            1 => Self::Diffuse,
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
    /// The colours that a script names by `name`.
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

impl Colour {
    /// An opaque colour with default highlights.
    pub const fn new(ambient_diffuse: [f32; 3]) -> Self {
        Self {
            ambient_diffuse,
            specular: [0.25; 3],
            emission: [0.0; 3],
            auxiliary: [0.5, 0.0, 0.0],
            opacity: 1.0,
        }
    }

    /// The numbers of one component.
    pub fn component(&self, component: ColourComponent) -> &[f32] {
        match component {
            ColourComponent::AmbientDiffuse => &self.ambient_diffuse,
            ColourComponent::Diffuse => &[0.0; 3],
            ColourComponent::Specular => &self.specular,
            ColourComponent::Emission => &self.emission,
            ColourComponent::Auxiliary => &self.auxiliary,
            ColourComponent::Transparency => std::slice::from_ref(&self.opacity),
        }
    }

    /// Sets one component; longer values are cut.
    pub fn set_component(&mut self, component: ColourComponent, value: &[f64]) {
        let slot: &mut [f32] = match component {
            ColourComponent::AmbientDiffuse => &mut self.ambient_diffuse,
            ColourComponent::Diffuse => &mut [],
            ColourComponent::Specular => &mut self.specular,
            ColourComponent::Emission => &mut self.emission,
            ColourComponent::Auxiliary => &mut self.auxiliary,
            ColourComponent::Transparency => std::slice::from_mut(&mut self.opacity),
        };
        slot.iter_mut()
            .zip(value)
            .for_each(|(number, new)| *number = *new as f32);
    }
}

/// The second colour of new joints and force sensors.
pub(crate) const SECOND_COLOUR: Colour = Colour::new([0.22; 3]);

impl Kind {
    /// The colour of a new object; shapes have theirs in their meshes. Values as files of the original hold them.
    pub(crate) fn default_colour(&self) -> Colour {
        Colour::new(match self {
            Self::Joint(_) => [1.0, 0.3, 0.1],
            Self::Graph(_) => [0.15; 3],
            Self::Camera(_) => [1.0, 0.294, 0.294],
            Self::Dummy(_) => [1.0, 0.8, 0.55],
            Self::ProximitySensor(_) => [0.9, 0.0, 0.5],
            Self::Path(_) => [0.1, 0.75, 1.0],
            Self::VisionSensor(_) => [0.05, 0.42, 1.0],
            Self::ForceSensor(_) => [0.22, 0.9, 0.45],
            Self::Light(_) => [0.7075, 0.7075, 0.9925],
            Self::Shape(_) | Self::OcTree(_) | Self::PointCloud(_) | Self::Script(_) => [1.0; 3],
        })
    }
}

impl Object {
    /// A colour of the object, if it has that one.
    pub fn colour(&self, slot: ColourSlot) -> Option<&Colour> {
        match (&self.kind, slot) {
            (Kind::Shape(shape), ColourSlot::Mesh(index)) => {
                Some(&shape.parts.get(index)?.appearance.colour)
            }
            (Kind::Light(light), ColourSlot::Second) => Some(&light.colour),
            (Kind::ProximitySensor(sensor), ColourSlot::Second) => Some(&sensor.ray_colour),
            (Kind::Joint(_) | Kind::ForceSensor(_), ColourSlot::Second) => {
                Some(&self.second_colour)
            }
            (Kind::Shape(_), _) => None,
            (_, ColourSlot::Body) => Some(&self.colour),
            _ => None,
        }
    }

    fn colour_mut(&mut self, slot: ColourSlot) -> Option<&mut Colour> {
        match (&mut self.kind, slot) {
            (Kind::Shape(shape), ColourSlot::Mesh(index)) => {
                Some(&mut shape.parts.get_mut(index)?.appearance.colour)
            }
            (Kind::Light(light), ColourSlot::Second) => Some(&mut light.colour),
            (Kind::ProximitySensor(sensor), ColourSlot::Second) => Some(&mut sensor.ray_colour),
            (Kind::Joint(_) | Kind::ForceSensor(_), ColourSlot::Second) => {
                Some(&mut self.second_colour)
            }
            (Kind::Shape(_), _) => None,
            (_, ColourSlot::Body) => Some(&mut self.colour),
            _ => None,
        }
    }

    /// The colour scripts give a number: meshes of shapes in order; otherwise 0 the body, 1 the second one.
    fn colour_slot(&self, index: usize) -> Option<ColourSlot> {
        let slot = match (&self.kind, index) {
            (Kind::Shape(_), _) => ColourSlot::Mesh(index),
            (_, 0) => ColourSlot::Body,
            (_, 1) => ColourSlot::Second,
            _ => return None,
        };
        self.colour(slot).is_some().then_some(slot)
    }
}

fn read(slot: &[f32]) -> Vec<f64> {
    slot.iter().map(|&number| number.into()).collect()
}

impl Shape {
    /// The colour of the first mesh called so, or of every mesh; None when there is none.
    pub fn colour(&self, name: &ColourName, component: ColourComponent) -> Option<Vec<f64>> {
        let mut colours = self
            .parts
            .iter()
            .map(|part| &part.appearance)
            .filter(|a| name.covers(a));
        match name {
            ColourName::Compound => Some(
                colours
                    .flat_map(|a| read(a.colour.component(component)))
                    .collect(),
            ),
            ColourName::All => colours
                .next_back()
                .map(|a| read(a.colour.component(component))),
            ColourName::Named(_) => colours.next().map(|a| read(a.colour.component(component))),
        }
    }

    /// Colours the meshes called so, or every mesh with its own value; those without one become black.
    ///
    /// # Errors
    /// When `value` has too few numbers for one; nothing is changed then.
    fn set_colour(
        &mut self,
        name: &ColourName,
        component: ColourComponent,
        value: &[f64],
    ) -> SceneResult<()> {
        let width = component.width();
        let each = if *name == ColourName::Compound {
            width
        } else {
            0
        };
        if value.len() < width {
            return Err(SceneError::InvalidArgument);
        }
        let black = [0.0; 3];
        for (i, part) in self
            .parts
            .iter_mut()
            .enumerate()
            .filter(|(_, part)| name.covers(&part.appearance))
        {
            let own = value.get(i * each..).filter(|own| own.len() >= width);
            part.appearance
                .colour
                .set_component(component, own.unwrap_or(&black));
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
        component: ColourComponent,
        value: &[f64],
    ) -> SceneResult<()> {
        self.try_modify(handle, Field::Appearance, |object| {
            object.shape_mut()?.set_colour(name, component, value)
        })
    }

    /// A colour of any object; None when it has no such one. Shapes have one per mesh, lights, joints, proximity and force sensors two.
    pub fn object_colour(
        &self,
        handle: Handle,
        index: usize,
        component: ColourComponent,
    ) -> SceneResult<Option<Vec<f64>>> {
        let object = self.object(handle)?;
        let colour = object
            .colour_slot(index)
            .and_then(|slot| object.colour(slot));
        Ok(colour.map(|colour| read(colour.component(component))))
    }

    /// Sets a colour of any object; false when it has no such one.
    pub fn set_object_colour(
        &mut self,
        handle: Handle,
        index: usize,
        component: ColourComponent,
        value: &[f64],
    ) -> SceneResult<bool> {
        match self.object(handle)?.colour_slot(index) {
            Some(slot) => self.set_colour(handle, slot, component, value),
            None => Ok(false),
        }
    }

    /// Sets one component of a colour; false when the object has no such colour.
    pub fn set_colour(
        &mut self,
        handle: Handle,
        slot: ColourSlot,
        component: ColourComponent,
        value: &[f64],
    ) -> SceneResult<bool> {
        if self.object(handle)?.colour(slot).is_none() {
            return Ok(false);
        }
        self.modify(handle, Field::Appearance, |object| {
            if let Some(colour) = object.colour_mut(slot) {
                colour.set_component(component, value);
            }
        })?;
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::{Light, LightType};
    use geometry::PrimitiveKind;

    #[test]
    fn colours_are_kept_in_32_bits_and_not_limited() {
        let mut shape =
            Shape::primitive(PrimitiveKind::Cuboid, [1.0; 3], Default::default()).unwrap();
        shape
            .set_colour(
                &ColourName::All,
                ColourComponent::AmbientDiffuse,
                &[2.0, -1.0, 0.2],
            )
            .unwrap();
        let colour = shape.colour(
            &ColourName::Named(String::new()),
            ColourComponent::AmbientDiffuse,
        );
        assert_eq!(colour, Some(vec![2.0, -1.0, f64::from(0.2f32)]));
        assert_eq!(
            shape.colour(
                &ColourName::Named("nope".into()),
                ColourComponent::AmbientDiffuse
            ),
            None
        );
    }

    #[test]
    fn a_light_has_two_colours() {
        let mut scene = Scene::new();
        let light = Kind::Light(Box::new(Light::new(LightType::Directional)));
        let light = scene.add("l", light).unwrap();
        assert_eq!(
            scene.set_object_colour(light, 1, ColourComponent::Specular, &[1.0, 0.0, 0.0]),
            Ok(true)
        );
        assert_eq!(
            scene.object_colour(light, 1, ColourComponent::Specular),
            Ok(Some(vec![1.0, 0.0, 0.0]))
        );
        assert_eq!(
            scene.object_colour(light, 0, ColourComponent::Specular),
            Ok(Some(vec![0.25; 3]))
        );
        assert_eq!(
            scene.object_colour(light, 2, ColourComponent::Specular),
            Ok(None)
        );
        let dummy = scene
            .add("d", Kind::Dummy(crate::object::dummy::Dummy::new(0.1)))
            .unwrap();
        assert_eq!(
            scene.set_object_colour(dummy, 1, ColourComponent::Specular, &[0.0; 3]),
            Ok(false)
        );
    }
}
