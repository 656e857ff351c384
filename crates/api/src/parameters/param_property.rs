//! Numbered parameters of the simulator that are properties by another name: the property is where the value is.

use crate::{Cx, Result};
use scene::special::{APP, SCENE};
use script::{PropertyTarget, PropertyValue};

/// The number of a parameter, the target of its property, and the property's name.
type PropertyParam = (i64, i64, &'static str);

/// `sim.intparam_*`.
pub(crate) const INTEGERS: &[PropertyParam] = &[
    (11, SCENE, "visibilityLayers"),
    (16, APP, "qtVersion"),
    (19, APP, "platform"),
    (20, SCENE, "sceneUid"),
    (26, APP, "idleFps"),
    (36, SCENE, "speedModifier"),
    (39, APP, "productVersionNb"),
    (40, APP, "consoleVerbosity"),
    (41, APP, "statusbarVerbosity"),
    (42, APP, "dialogVerbosity"),
    (48, SCENE, "objectCreationCounter"),
    (49, SCENE, "objectDestructionCounter"),
    (50, SCENE, "hierarchyChangeCounter"),
    (51, APP, "notifyDeprecated"),
    (52, APP, "processId"),
    (53, APP, "processCnt"),
];

/// `sim.boolparam_*`.
pub(crate) const SWITCHES: &[PropertyParam] = &[
    (0, APP, "hierarchyEnabled"),
    (6, SCENE, "dynamicsEnabled"),
    (12, APP, "browserEnabled"),
    (16, APP, "displayEnabled"),
    (25, SCENE, "realtimeSimulation"),
    (58, APP, "execUnsafe"),
    (59, APP, "execUnsafeExt"),
    (60, APP, "canSave"),
];

/// `sim.floatparam_*`.
pub(crate) const FLOATS: &[PropertyParam] = &[
    (1, SCENE, "timeStep"),
    (3, SCENE, "dynamicsStepSize"),
    (5, SCENE, "dynamicsStepSize"),
];

/// `sim.arrayparam_*` that are colours.
pub(crate) const LIGHT: &[PropertyParam] = &[(5, SCENE, "ambientLight")];

/// `sim.stringparam_*`.
pub(crate) const TEXTS: &[PropertyParam] = &[
    (0, APP, "appPath"),
    (2, APP, "appArg1"),
    (3, APP, "appArg2"),
    (4, APP, "appArg3"),
    (5, APP, "appArg4"),
    (6, APP, "appArg5"),
    (7, APP, "appArg6"),
    (8, APP, "appArg7"),
    (9, APP, "appArg8"),
    (10, APP, "appArg9"),
    (13, SCENE, "scenePath"),
    (118, SCENE, "sceneUidString"),
    (119, APP, "machineId"),
    (120, APP, "legacyMachineId"),
    (126, APP, "randomString"),
    (127, APP, "tempPath"),
    (128, APP, "sceneTempPath"),
    (129, APP, "settingsPath"),
    (130, APP, "importExportPath"),
    (131, APP, "addOnPath"),
    (132, APP, "scenePath"),
    (133, APP, "modelPath"),
    (134, APP, "defaultPython"),
    (136, APP, "luaPath"),
    (137, APP, "pythonPath"),
    (138, APP, "mujocoPath"),
    (139, APP, "settingsPath"),
    (140, APP, "systemPath"),
    (141, APP, "resourcePath"),
    (143, APP, "addOnPath"),
    (144, APP, "sandboxLang"),
];

/// Texts that set a level by its name.
pub(crate) const LEVELS: &[PropertyParam] = &[
    (121, APP, "consoleVerbosityStr"),
    (122, APP, "statusbarVerbosityStr"),
    (123, APP, "dialogVerbosityStr"),
];

fn property_of(params: &[PropertyParam], number: i64) -> Option<(PropertyTarget, &'static str)> {
    let &(_, target, name) = params.iter().find(|(known, ..)| *known == number)?;
    Some((
        if target == APP {
            PropertyTarget::App
        } else {
            PropertyTarget::Scene
        },
        name,
    ))
}

/// The value of the property that `number` is; None when it is none.
pub(crate) fn read<T: PropertyValue>(
    cx: &Cx,
    params: &[PropertyParam],
    number: i64,
) -> Result<Option<T>> {
    let Some((target, name)) = property_of(params, number) else {
        return Ok(None);
    };
    Ok(T::from_data(cx.read_property(&target, name, T::TYPE)?))
}

/// Sets the property with that parameter number; returns whether there is one.
pub(crate) fn write<T: PropertyValue>(
    cx: &mut Cx,
    params: &[PropertyParam],
    number: i64,
    value: T,
) -> Result<bool> {
    let Some((target, name)) = property_of(params, number) else {
        return Ok(false);
    };
    cx.write_property(&target, name, (T::TYPE, value.into_data()))?;
    Ok(true)
}
