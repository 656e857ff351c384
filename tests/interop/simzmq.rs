//! simZMQ with pyzmq and with another simulator: the files `simzmq_*.py`, which start the program themselves.

use crate::web::check;

#[test]
#[cfg(target_os = "linux")]
fn sockets_of_every_type() {
    check("simzmq_module.py");
}

#[test]
#[cfg(unix)]
fn scenes_that_say_hello() {
    check("simzmq_scenes.py");
}
