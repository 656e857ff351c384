//! The types by name.

mod built_in;
mod derived;
mod folders;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use derived::part_of;
use folders::Folders;

use crate::types::Structure;
use crate::{
    Element, Field, FieldType, Generation, Interface, InterfaceError, InterfaceKind, Layout,
    TypeName, limits, parse,
};

/// All types of one generation of ROS. Files are read when a type is first asked for.
///
/// Structures within services and actions have names of their own: `std_srvs/srv/SetBool_Request`, `..._Response`,
/// `example_interfaces/action/Fibonacci_Goal`, `..._Result`, `..._Feedback`; in ROS 2 also what its actions exchange:
/// `..._SendGoal_Request`, `..._SendGoal_Response`, `..._GetResult_Request`, `..._GetResult_Response`, `..._FeedbackMessage`.
#[derive(Clone)]
pub struct Catalogue {
    generation: Generation,
    folders: Folders,
    interfaces: BTreeMap<TypeName, Arc<Interface>>,
    layouts: BTreeMap<TypeName, Arc<Layout>>,
}

impl Catalogue {
    /// With the built-in types.
    #[must_use]
    pub fn new(generation: Generation) -> Self {
        let interfaces = built_in::interfaces(generation);
        let by_name = interfaces
            .into_iter()
            .map(|interface| (interface.name.clone(), Arc::new(interface)));
        Self {
            generation,
            folders: Folders::default(),
            interfaces: by_name.collect(),
            layouts: BTreeMap::new(),
        }
    }

    /// Which system it is for.
    #[must_use]
    pub fn generation(&self) -> Generation {
        self.generation
    }

    /// Searches further types in a folder, after those that are known. It may be a prefix of an installation (`share/PACKAGE/msg`), contain
    /// packages (`PACKAGE/msg`), perhaps in folders of their own, or be a package itself.
    pub fn add_folder(&mut self, folder: impl Into<PathBuf>) {
        self.folders.add(folder.into());
    }

    /// Adds the text of an interface, in place of another of the same name that nobody has used.
    ///
    /// # Errors
    /// Line, and what is wrong there.
    pub fn add_text(&mut self, name: &TypeName, text: &str) -> Result<(), InterfaceError> {
        let interface = parse::parse(name, text, self.generation, &name.to_string())?;
        self.interfaces.insert(name.clone(), Arc::new(interface));
        Ok(())
    }

    /// The names of all interfaces that are known or found in the folders, in order.
    #[must_use]
    pub fn names(&self) -> Vec<TypeName> {
        let mut names: Vec<TypeName> = self
            .interfaces
            .keys()
            .cloned()
            .chain(self.folders.names())
            .collect();
        names.sort();
        names.dedup();
        names
    }

    /// What the text of an interface says.
    ///
    /// # Errors
    /// If there is none, or it cannot be read.
    pub fn interface(&mut self, name: &TypeName) -> Result<Arc<Interface>, InterfaceError> {
        if let Some(known) = self.interfaces.get(name) {
            return Ok(known.clone());
        }
        let (path, text) = self
            .folders
            .read(name)?
            .ok_or_else(|| InterfaceError::Unknown(name.to_string()))?;
        let interface = Arc::new(parse::parse(name, &text, self.generation, &path)?);
        self.interfaces.insert(name.clone(), interface.clone());
        Ok(interface)
    }

    /// The type of a message, or of a part of a service or an action, by its full or short name.
    ///
    /// # Errors
    /// If there is none, it cannot be read, or it is nested in itself or too deeply.
    pub fn layout(&mut self, name: &str) -> Result<Arc<Layout>, InterfaceError> {
        self.layout_of(&TypeName::parse(name, InterfaceKind::Message)?)
    }

    /// As [`Catalogue::layout`], by a name that was read before.
    ///
    /// # Errors
    /// As there.
    pub fn layout_of(&mut self, name: &TypeName) -> Result<Arc<Layout>, InterfaceError> {
        match part_of(name, self.generation) {
            Some(part) => self.resolve(&part.name, &mut Vec::new()),
            None => self.resolve(name, &mut Vec::new()),
        }
    }

    /// Request and response of a service.
    ///
    /// # Errors
    /// As [`Catalogue::layout`].
    pub fn service(&mut self, name: &str) -> Result<[Arc<Layout>; 2], InterfaceError> {
        let name = TypeName::parse(name, InterfaceKind::Service)?;
        if name.kind != InterfaceKind::Service {
            return Err(InterfaceError::Unknown(name.to_string()));
        }
        let part = |suffix| TypeName {
            name: format!("{}_{suffix}", name.name),
            ..name.clone()
        };
        self.interface(&name)?;
        Ok([
            self.layout_of(&part("Request"))?,
            self.layout_of(&part("Response"))?,
        ])
    }

    /// `outer` are the types that are being resolved.
    fn resolve(
        &mut self,
        name: &TypeName,
        outer: &mut Vec<TypeName>,
    ) -> Result<Arc<Layout>, InterfaceError> {
        if let Some(known) = self.layouts.get(name) {
            return Ok(known.clone());
        }
        if outer.contains(name) {
            return Err(InterfaceError::Cycle(name.to_string()));
        }
        if outer.len() == limits::NESTING {
            return Err(InterfaceError::Nesting(outer[0].to_string()));
        }
        let structure = self.structure(name)?;
        outer.push(name.clone());
        let fields = structure
            .fields
            .iter()
            .map(|field| self.resolve_field(name, field, outer));
        let fields = fields.collect::<Result<Vec<_>, _>>();
        outer.pop();
        let layout = Arc::new(Layout::new(name.clone(), structure.constants, fields?));
        if layout.fixed_values > limits::FIXED_VALUES {
            return Err(InterfaceError::TooLarge(name.to_string()));
        }
        self.layouts.insert(name.clone(), layout.clone());
        Ok(layout)
    }

    fn structure(&mut self, name: &TypeName) -> Result<Structure, InterfaceError> {
        if name.kind == InterfaceKind::Message {
            return Ok(self.interface(name)?.parts[0].clone());
        }
        let unknown = || InterfaceError::Unknown(name.to_string());
        let part = part_of(name, self.generation).ok_or_else(unknown)?;
        let interface = self.interface(&part.interface)?;
        Ok(part.structure(&interface))
    }

    fn resolve_field(
        &mut self,
        outer_name: &TypeName,
        field: &Field<TypeName>,
        outer: &mut Vec<TypeName>,
    ) -> Result<Field<Arc<Layout>>, InterfaceError> {
        let element = match &field.field_type.element {
            Element::Nested(name) => {
                let nested = |problem: InterfaceError| match problem {
                    InterfaceError::Cycle(_)
                    | InterfaceError::Nesting(_)
                    | InterfaceError::Nested { .. } => problem,
                    problem => InterfaceError::Nested {
                        outer: outer_name.to_string(),
                        inner: name.to_string(),
                        problem: Box::new(problem),
                    },
                };
                Element::Nested(self.resolve(name, outer).map_err(nested)?)
            }
            Element::Number(number) => Element::Number(*number),
            Element::String(bound) => Element::String(*bound),
            Element::WString(bound) => Element::WString(*bound),
            Element::Time => Element::Time,
            Element::Duration => Element::Duration,
        };
        let field_type = FieldType {
            element,
            shape: field.field_type.shape,
        };
        Ok(Field {
            name: field.name.clone(),
            field_type,
            default: field.default.clone(),
        })
    }
}
