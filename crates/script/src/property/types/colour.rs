//! Colours of objects and meshes.

use super::access::{Accessor, Subject, subject_properties};
use super::{Color, PropertyTarget};
use crate::error::{ApiError, ApiResult};
use scene::Handle;
use scene::appearance::colour::{ColourComponent, ColourSlot};

impl Subject<'_> {
    /// The object and the colour meant by `slot`; of a mesh it is its own.
    fn coloured(&self, slot: ColourSlot) -> ApiResult<(Handle, ColourSlot)> {
        match self.target {
            PropertyTarget::Mesh(uid) => {
                let (shape, index) = self
                    .sim
                    .scene
                    .borrow()
                    .mesh(*uid)
                    .ok_or(ApiError::NoSuchTarget)?;
                Ok((shape, ColourSlot::Mesh(index)))
            }
            _ => Ok((self.object()?, slot)),
        }
    }

    fn colour(&self, slot: ColourSlot, component: ColourComponent) -> ApiResult<Vec<f64>> {
        let (handle, slot) = self.coloured(slot)?;
        let scene = self.sim.scene.borrow();
        let colour = scene
            .object(handle)?
            .colour(slot)
            .ok_or(ApiError::PropertyNotReadable)?;
        Ok(colour
            .component(component)
            .iter()
            .map(|&part| part.into())
            .collect())
    }

    fn rgb(&self, slot: ColourSlot, component: ColourComponent) -> ApiResult<Color> {
        let rgb = self
            .colour(slot, component)?
            .try_into()
            .map_err(|_| ApiError::PropertyNotReadable)?;
        Ok(Color(rgb))
    }

    fn set_colour(
        &self,
        slot: ColourSlot,
        component: ColourComponent,
        value: &[f64],
    ) -> ApiResult<()> {
        let (handle, slot) = self.coloured(slot)?;
        let known = self
            .sim
            .scene
            .borrow_mut()
            .set_colour(handle, slot, component, value)?;
        if known {
            Ok(())
        } else {
            Err(ApiError::PropertyNotWritable)
        }
    }

    /// 0 for opaque: the contrary of what is kept.
    fn transparency(&self, slot: ColourSlot) -> ApiResult<f64> {
        Ok(1.0
            - self
                .colour(slot, ColourComponent::Transparency)?
                .first()
                .copied()
                .unwrap_or(1.0))
    }

    fn set_transparency(&self, slot: ColourSlot, transparency: f64) -> ApiResult<()> {
        self.set_colour(slot, ColourComponent::Transparency, &[1.0 - transparency])
    }
}

/// Rows of the components of one colour.
macro_rules! colours {
    ($slot:ident: $diffuse:literal, $specular:literal, $emission:literal $(, $transparency:literal)?) => { subject_properties! {
        $diffuse: Color, |s| s.rgb(ColourSlot::$slot, ColourComponent::AmbientDiffuse)?,
            |s, rgb| s.set_colour(ColourSlot::$slot, ColourComponent::AmbientDiffuse, &rgb.0)?;
        $specular: Color, |s| s.rgb(ColourSlot::$slot, ColourComponent::Specular)?,
            |s, rgb| s.set_colour(ColourSlot::$slot, ColourComponent::Specular, &rgb.0)?;
        $emission: Color, |s| s.rgb(ColourSlot::$slot, ColourComponent::Emission)?,
            |s, rgb| s.set_colour(ColourSlot::$slot, ColourComponent::Emission, &rgb.0)?;
        $($transparency: f64, |s| s.transparency(ColourSlot::$slot)?,
            |s, part| s.set_transparency(ColourSlot::$slot, part)?;)?
    } };
}

pub(in crate::property) const COLOUR: &[Accessor] =
    colours!(Body: "color.diffuse", "color.specular", "color.emission", "color.transparency");

pub(in crate::property) const RAY_COLOUR: &[Accessor] = colours!(Second: "rayColor.diffuse", "rayColor.specular", "rayColor.emission", "rayColor.transparency");

pub(in crate::property) const LIGHT_COLOUR: &[Accessor] =
    colours!(Second: "lightColor.diffuse", "lightColor.specular", "lightColor.emission");
