//! `sim.*`: typed properties of the application, the scene, objects and scripts.

use api_macro::api;

use crate::{ApiError, ApiFn, Args, Cx, FromScript, Result, functions};
use scene::{Data, Key};
use script::Source;
use script::{
    Bytes, Color, IntPair, Long, PoseArray, PropertyName, PropertyValue, Quaternion, Table, Text,
    Vector2, Vector3,
};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    get_bool_property,
    set_bool_property,
    get_int_property,
    set_int_property,
    get_long_property,
    set_long_property,
    get_float_property,
    set_float_property,
    get_string_property,
    set_string_property,
    get_buffer_property,
    set_buffer_property,
    get_table_property,
    set_table_property,
    get_int_array_property,
    set_int_array_property,
    get_handle_property,
    set_handle_property,
    get_handle_array_property,
    set_handle_array_property,
    get_int_array2_property,
    set_int_array2_property,
    get_float_array_property,
    set_float_array_property,
    get_vector2_property,
    set_vector2_property,
    get_vector3_property,
    set_vector3_property,
    get_quaternion_property,
    set_quaternion_property,
    get_pose_property,
    set_pose_property,
    get_color_property,
    set_color_property,
    remove_property,
    get_property_info,
    get_property_name,
];

/// The `options` table of the property functions.
#[derive(Default)]
struct Options {
    /// Return nothing on failure instead of raising an error.
    no_error: bool,
    /// Only names that begin with it.
    prefix: String,
}

impl From<Options> for Data {
    fn from(Options { no_error, prefix }: Options) -> Self {
        let no_error = no_error.then(|| (Key::Text(b"noError".to_vec()), true.into()));
        let prefix = (!prefix.is_empty()).then(|| (Key::Text(b"prefix".to_vec()), prefix.into()));
        Self::Map(no_error.into_iter().chain(prefix).collect())
    }
}

impl FromScript for Options {
    const TYPE: &'static str = "map";

    fn from_script<'a, S: Source<'a>>(args: &Args<'a, S>) -> Result<Self> {
        let table = Table::from_script(args)?.0;
        let prefix = match table.field("prefix") {
            Some(Data::Text(prefix)) => String::from_utf8_lossy(prefix).into_owned(),
            _ => String::new(),
        };
        Ok(Self {
            no_error: table.field("noError").is_some_and(Data::truthy),
            prefix,
        })
    }
}

impl Options {
    /// Nothing instead of an error, if the options request that.
    fn apply<T>(&self, outcome: Result<T>) -> Result<Option<T>> {
        match outcome {
            Ok(value) => Ok(Some(value)),
            Err(_) if self.no_error => Ok(None),
            Err(error) => Err(error),
        }
    }
}

fn read<T: PropertyValue>(cx: &Cx, target: i64, name: &str) -> Result<T> {
    let target = cx.property_target(target)?;
    let data = cx.read_property(&target, name, T::TYPE)?;
    T::from_data(data).ok_or_else(|| ApiError::Other("property is corrupt.".into()))
}

fn write<T: PropertyValue>(cx: &mut Cx, target: i64, name: &str, value: T) -> Result<()> {
    let target = cx.property_target(target)?;
    cx.write_property(&target, name, (T::TYPE, value.into_data()))
}

/// A getter and a setter for each type.
macro_rules! typed_properties {
    ($($ty:ty: $get:ident $get_name:tt, $set:ident $set_name:tt;)*) => { $(
        /// Value of a property.
        ///
        /// @param target object or script, sim.handle_app, sim.handle_scene, sim.handle_self
        /// @param propertyName its name
        /// @param options noError: nothing instead of an error
        /// @return propertyState
        #[api($get_name)]
        fn $get(
            cx: &Cx, target: i64, property_name: PropertyName, #[default(Options::default())] options: Options,
        ) -> Result<Option<$ty>> {
            options.apply(read(cx, target, property_name.as_str()))
        }

        /// Sets a property; names below `customData.` and `signal.` are created.
        ///
        /// @param target object or script, sim.handle_app, sim.handle_scene, sim.handle_self
        /// @param propertyName its name
        /// @param propertyState the new value
        /// @param options noError: no error when that fails
        #[api($set_name)]
        fn $set(
            cx: &mut Cx, target: i64, property_name: PropertyName, property_state: $ty,
            #[default(Options::default())] options: Options,
        ) -> Result<()> {
            options.apply(write(cx, target, property_name.as_str(), property_state)).map(drop)
        }
    )* };
}

typed_properties! {
    bool: get_bool_property "sim.getBoolProperty", set_bool_property "sim.setBoolProperty";
    i64: get_int_property "sim.getIntProperty", set_int_property "sim.setIntProperty";
    Long: get_long_property "sim.getLongProperty", set_long_property "sim.setLongProperty";
    f64: get_float_property "sim.getFloatProperty", set_float_property "sim.setFloatProperty";
    Text: get_string_property "sim.getStringProperty", set_string_property "sim.setStringProperty";
    Bytes: get_buffer_property "sim.getBufferProperty", set_buffer_property "sim.setBufferProperty";
    Table: get_table_property "sim.getTableProperty", set_table_property "sim._setTableProperty";
    Vec<i64>: get_int_array_property "sim.getIntArrayProperty", set_int_array_property "sim.setIntArrayProperty";
    i64: get_handle_property "sim.getHandleProperty", set_handle_property "sim.setHandleProperty";
    Vec<i64>: get_handle_array_property "sim.getHandleArrayProperty", set_handle_array_property "sim.setHandleArrayProperty";
    IntPair: get_int_array2_property "sim.getIntArray2Property", set_int_array2_property "sim.setIntArray2Property";
    Vec<f64>: get_float_array_property "sim.getFloatArrayProperty", set_float_array_property "sim.setFloatArrayProperty";
    Vector2: get_vector2_property "sim.getVector2Property", set_vector2_property "sim.setVector2Property";
    Vector3: get_vector3_property "sim.getVector3Property", set_vector3_property "sim.setVector3Property";
    Quaternion: get_quaternion_property "sim.getQuaternionProperty", set_quaternion_property "sim.setQuaternionProperty";
    PoseArray: get_pose_property "sim.getPoseProperty", set_pose_property "sim.setPoseProperty";
    Color: get_color_property "sim.getColorProperty", set_color_property "sim.setColorProperty";
}

/// Removes custom data, a signal or a named parameter.
///
/// @param target object, sim.handle_app or sim.handle_scene
/// @param propertyName with its prefix `customData.`, `signal.` or `namedParam.`
/// @param options noError: no error when there is none
#[api("sim.removeProperty")]
fn remove_property(
    cx: &mut Cx,
    target: i64,
    property_name: PropertyName,
    #[default(Options::default())] options: Options,
) -> Result<()> {
    let target = cx.property_target(target)?;
    options
        .apply(cx.remove_property(&target, property_name.as_str()))
        .map(drop)
}

/// Type, flags and description of a property; nothing if unknown.
///
/// @param target object or script, sim.handle_app, sim.handle_scene, sim.handle_self
/// @param propertyName its name
/// @param options accepted
/// @return type, flags, description
#[api("sim.getPropertyInfo")]
fn get_property_info(
    cx: &Cx,
    target: i64,
    property_name: PropertyName,
    #[default(Options::default())] _options: Options,
) -> Result<Option<(i64, i64, &'static str)>> {
    let target = cx.property_target(target)?;
    let name = property_name.as_str();
    Ok(cx
        .property_info(&target, name)
        .map(|(ty, flags)| (ty as i64, flags, cx.property_description(&target, name))))
}

/// The properties of a target one by one; nothing past the last one.
///
/// @param target object or script, sim.handle_app, sim.handle_scene, sim.handle_self
/// @param index from 0
/// @param options prefix: only names that begin with it
/// @return propertyName, appartenance
#[api("sim.getPropertyName")]
fn get_property_name(
    cx: &Cx,
    target: i64,
    index: i64,
    #[default(Options::default())] options: Options,
) -> Result<Option<(String, &'static str)>> {
    let target = cx.property_target(target)?;
    let Ok(index) = usize::try_from(index) else {
        return Ok(None);
    };
    Ok(cx.property_name(&target, index, &options.prefix))
}
