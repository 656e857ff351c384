//! Inert properties: stored and read back without effect.

use super::{PropertyTarget, Sim};
use crate::error::{ApiError, ApiResult};
use scene::Data;

impl Sim {
    /// An inert value; None if it was not set.
    pub(super) fn read_inert(
        &self,
        target: &PropertyTarget,
        name: &str,
    ) -> ApiResult<Option<Data>> {
        match target {
            PropertyTarget::App => Ok(self.app.borrow().inert.get(name).cloned()),
            PropertyTarget::Scene => Ok(self.scene.borrow().inert_value(None, name)?.cloned()),
            PropertyTarget::Object(handle) => Ok(self
                .scene
                .borrow()
                .inert_value(Some(*handle), name)?
                .cloned()),
            PropertyTarget::Mesh(_) | PropertyTarget::Script(_) => Ok(None),
        }
    }

    /// Sets the value.
    pub(super) fn write_inert(
        &self,
        target: &PropertyTarget,
        name: &'static str,
        value: Data,
    ) -> ApiResult<()> {
        match target {
            PropertyTarget::App => {
                self.app.borrow_mut().inert.set(name, value);
            }
            PropertyTarget::Scene => self.scene.borrow_mut().set_inert_value(None, name, value)?,
            PropertyTarget::Object(handle) => {
                self.scene
                    .borrow_mut()
                    .set_inert_value(Some(*handle), name, value)?;
            }
            PropertyTarget::Mesh(_) | PropertyTarget::Script(_) => {
                return Err(ApiError::PropertyNotWritable);
            }
        }
        Ok(())
    }
}
