//! A simulator in the making.

use std::rc::Rc;

use swanilda::{Options, ScriptKind};

use crate::console::PythonConsole;
use crate::convert::callables::Callables;
use crate::host::ThisPython;
use crate::script::MainProgram;
use crate::worlds::branches::Branches;
use crate::worlds::{self, Shared, Speaker, World};

/// A simulator with an empty scene, in whose name Python's main program calls.
pub fn made(options: Options, quiet: bool) -> World {
    let (callables, shared) = (Rc::<Callables>::default(), Rc::<Shared>::default());
    let builder = swanilda::Simulator::builder().options(options);
    let builder = builder.python(Rc::new(ThisPython {
        shared: Rc::clone(&shared),
    }));
    let builder = if quiet {
        builder
    } else {
        builder.console(Box::new(PythonConsole(Rc::clone(&shared))))
    };
    let mut simulator = builder.build();
    let (functions, exceptions) = (Rc::clone(&callables), Rc::clone(&shared));
    let main = simulator.add_native_script(ScriptKind::AddOn, "Python", move |_| {
        Ok(Box::new(MainProgram {
            callables: Rc::clone(&functions),
            shared: Rc::clone(&exceptions),
        }))
    });
    let main = main.expect("add-ons are no objects, for which there could be no room");
    let main = Rc::new(Speaker {
        caller: simulator.caller(&main),
        callables,
    });
    let number = worlds::new_number();
    World {
        number,
        branches: Branches::only(number).into(),
        simulator: simulator.into(),
        main,
        shared,
        viewer: None.into(),
        recording: None.into(),
    }
}
