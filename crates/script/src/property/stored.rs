//! Properties created by scripts: custom data, signals, named parameters.

use super::table::flags;
use super::{Info, PropertyTarget, Sim};
use crate::error::{ApiError, ApiResult};
use crate::host::Script;
use scene::{CustomData, Data, Edit, Handle, Holder, Namespace, ValueType};

/// What the names of signals begin with that the older functions set: integers, floats, texts, doubles.
pub const OLD_SIGNALS: [&str; 4] = ["ILEGACY.", "FLEGACY.", "SLEGACY.", "DLEGACY."];

/// What the names of custom data and signals begin with.
const PREFIXES: [(Namespace, &str); 2] = [
    (Namespace::CustomData, "customData"),
    (Namespace::Signal, "signal"),
];

/// Whether a new property may have that name.
pub(crate) fn is_valid_name(name: &str) -> bool {
    !name.is_empty()
        && name
            .bytes()
            .all(|byte| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'.'))
}

/// Whether custom data or a signal may have that name. Signals of the older functions are texts without spaces, such as
/// `/blueArm_executedMovId`.
fn may_be_named(namespace: Namespace, name: &str) -> bool {
    let is_old_signal = || {
        let old_name = OLD_SIGNALS.iter().find_map(|kind| name.strip_prefix(kind));
        old_name.is_some_and(|old| !old.contains(|c: char| c.is_whitespace() || c.is_control()))
    };
    is_valid_name(name) || namespace == Namespace::Signal && is_old_signal()
}

impl PropertyTarget {
    /// None for scripts that are no objects: they hold no named values.
    fn holder(&self) -> Option<Holder> {
        match self {
            Self::App => Some(Holder::App),
            Self::Scene => Some(Holder::Scene),
            Self::Object(handle) => Some(Holder::Object(*handle)),
            Self::Script(_) | Self::Mesh(_) => None,
        }
    }
}

/// The object among the holders; None for the scene.
fn object_of(holder: Holder) -> Option<Handle> {
    if let Holder::Object(handle) = holder {
        Some(handle)
    } else {
        None
    }
}

impl Sim {
    fn with_stored<R>(
        &self,
        holder: Holder,
        namespace: Namespace,
        read: impl FnOnce(&CustomData) -> R,
    ) -> ApiResult<R> {
        if holder == Holder::App {
            return Ok(match namespace {
                Namespace::CustomData => {
                    self.with_app_storage(|storage| read(storage.custom_data()))
                }
                Namespace::Signal => read(&self.app.borrow().signals),
            });
        }
        let scene = self.scene.borrow();
        Ok(read(scene.named_values(object_of(holder), namespace)?))
    }

    /// All changes of named values go through here; returns whether anything changed.
    fn edit_stored(&self, holder: Holder, namespace: Namespace, edit: Edit<'_>) -> ApiResult<bool> {
        if holder != Holder::App {
            return Ok(self.scene.borrow_mut().edit_named_values(
                object_of(holder),
                namespace,
                edit,
            )?);
        }
        let edited = match namespace {
            Namespace::CustomData => {
                self.with_app_storage(|storage| storage.edit_custom_data(edit))
            }
            Namespace::Signal => self.app.borrow_mut().signals.edit(edit),
        };
        self.scene
            .borrow_mut()
            .journal_mut()
            .note_stored(holder, namespace, &edited);
        Ok(edited.any())
    }

    /// Reads custom data or signals as a whole.
    ///
    /// # Errors
    /// When the target has none or is gone.
    pub(crate) fn with_named_values<R>(
        &self,
        target: &PropertyTarget,
        namespace: Namespace,
        read: impl FnOnce(&CustomData) -> R,
    ) -> ApiResult<R> {
        self.with_stored(
            target.holder().ok_or(ApiError::NoSuchTarget)?,
            namespace,
            read,
        )
    }

    /// Changes custom data or signals; returns whether anything changed.
    ///
    /// # Errors
    /// When the target has none or is gone.
    pub(crate) fn edit_named_values(
        &self,
        target: &PropertyTarget,
        namespace: Namespace,
        edit: Edit<'_>,
    ) -> ApiResult<bool> {
        self.edit_stored(
            target.holder().ok_or(ApiError::NoSuchTarget)?,
            namespace,
            edit,
        )
    }

    pub(super) fn read_stored(
        &self,
        target: &PropertyTarget,
        namespace: Namespace,
        name: &str,
        ty: ValueType,
    ) -> ApiResult<Data> {
        // Tags of raw custom data may have other characters; they are no properties then.
        if !may_be_named(namespace, name) {
            return Err(ApiError::UnknownProperty);
        }
        let holder = target.holder().ok_or(ApiError::UnknownProperty)?;
        self.with_stored(holder, namespace, |values| match values.typed(name) {
            None => Err(ApiError::UnknownProperty),
            Some((stored, _)) if stored != ty => Err(ApiError::PropertyType),
            Some((_, value)) => Ok(value.clone()),
        })?
    }

    pub(super) fn write_stored(
        &self,
        target: &PropertyTarget,
        namespace: Namespace,
        name: &str,
        (ty, value): (ValueType, Data),
        writer: &Script,
    ) -> ApiResult<()> {
        if !may_be_named(namespace, name) {
            return Err(ApiError::PropertyName);
        }
        let holder = target.holder().ok_or(ApiError::UnknownProperty)?;
        self.edit_stored(holder, namespace, Edit::Name(name, Some((ty, value))))?;
        if namespace == Namespace::Signal {
            self.signal_owners.borrow_mut().set(holder, name, writer.id);
        }
        Ok(())
    }

    pub(super) fn remove_stored(
        &self,
        target: &PropertyTarget,
        namespace: Namespace,
        name: &str,
    ) -> ApiResult<bool> {
        let holder = target.holder().ok_or(ApiError::UnknownProperty)?;
        if namespace == Namespace::Signal {
            self.signal_owners.borrow_mut().remove(holder, name);
        }
        self.edit_stored(holder, namespace, Edit::Name(name, None))
    }

    pub(super) fn stored_info(
        &self,
        target: &PropertyTarget,
        namespace: Namespace,
        name: &str,
    ) -> Option<Info> {
        let ty = self
            .with_stored(target.holder()?, namespace, |values| {
                values.typed(name).map(|(ty, _)| ty)
            })
            .ok()??;
        let volatile = if namespace == Namespace::Signal {
            flags::MODEL_HASH_EXCLUDE
        } else {
            0
        };
        Some((ty, flags::REMOVABLE | volatile))
    }

    /// Names of custom data, then of signals, then of named parameters.
    pub fn stored_names(&self, target: &PropertyTarget) -> Vec<String> {
        let Some(holder) = target.holder() else {
            return Vec::new();
        };
        let mut names = Vec::new();
        for (namespace, prefix) in PREFIXES {
            let found = self.with_stored(holder, namespace, |values| {
                values
                    .names()
                    .map(|name| format!("{prefix}.{name}"))
                    .collect::<Vec<_>>()
            });
            names.extend(found.unwrap_or_default());
        }
        if holder == Holder::App {
            names.extend(
                self.app
                    .borrow()
                    .named_params
                    .keys()
                    .map(|name| format!("namedParam.{name}")),
            );
        }
        names
    }

    /// The name at a position in the list of [`Sim::stored_names`], or how long that list is.
    pub(super) fn stored_name_at(
        &self,
        target: &PropertyTarget,
        mut position: usize,
    ) -> Result<String, usize> {
        let holder = target.holder().ok_or(0_usize)?;
        let mut count = 0;
        for (namespace, prefix) in PREFIXES {
            let found = self.with_stored(holder, namespace, |values| {
                let name = values.name_at(position);
                name.map_or(Err(values.len()), |name| Ok(format!("{prefix}.{name}")))
            });
            match found {
                Ok(Ok(name)) => return Ok(name),
                Ok(Err(len)) => (position, count) = (position - len, count + len),
                Err(_) => {}
            }
        }
        let app = self.app.borrow();
        let params = Some(&app.named_params).filter(|_| holder == Holder::App);
        let name = params.and_then(|params| params.keys().nth(position));
        name.map(|name| format!("namedParam.{name}"))
            .ok_or(count + params.map_or(0, |params| params.len()))
    }

    /// Removes the signals whose last writer's interpreter ends.
    pub(crate) fn drop_signals_of(&self, script: &Script) {
        let owned = self.signal_owners.borrow_mut().take(script.id);
        for (holder, name) in owned {
            // An object that is gone took its signals along.
            let _ = self.edit_stored(holder, Namespace::Signal, Edit::Name(&name, None));
        }
    }

    pub(super) fn read_param(&self, name: &str, ty: ValueType) -> ApiResult<Data> {
        match self.app.borrow().read_param(name) {
            None => Err(ApiError::UnknownProperty),
            Some(_) if ty != ValueType::String => Err(ApiError::PropertyType),
            Some(value) => Ok(Data::Text(value)),
        }
    }

    pub(super) fn write_param(&self, name: &str, ty: ValueType, value: Data) -> ApiResult<()> {
        let (ValueType::String, Data::Text(text)) = (ty, value) else {
            return Err(ApiError::PropertyType);
        };
        if !is_valid_name(name) {
            return Err(ApiError::PropertyName);
        }
        self.app
            .borrow_mut()
            .named_params
            .insert(name.to_owned(), text);
        Ok(())
    }
}
