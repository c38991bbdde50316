//! The other end of a drop: what a file manager does, by the XDND protocol, version 5
//! (https://freedesktop.org/wiki/Specifications/XDND).

use crate::support::PATIENCE;
use std::error::Error;
use std::path::Path;
use std::time::{Duration, Instant};
use x11rb::connection::Connection;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{
    ClientMessageEvent, ConnectionExt as _, CreateWindowAux, EventMask, PropMode,
    SELECTION_NOTIFY_EVENT, SelectionNotifyEvent, WindowClass,
};
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;

const VERSION: u32 = 5;

/// Between two movements of the hand.
const MOVEMENT: Duration = Duration::from_secs(2);

struct Atoms {
    selection: u32,
    uri_list: u32,
    enter: u32,
    position: u32,
    status: u32,
    drop: u32,
    finished: u32,
    copy: u32,
}

/// Drops `path` on the window `target` of an X display, at a point of the screen.
pub fn drop_file(
    display: &str,
    target: u32,
    (x, y): (u16, u16),
    path: &Path,
) -> Result<(), Box<dyn Error>> {
    let (connection, screen) = RustConnection::connect(Some(display))?;
    let atom = |name: &str| -> Result<u32, Box<dyn Error>> {
        Ok(connection
            .intern_atom(false, name.as_bytes())?
            .reply()?
            .atom)
    };
    let atoms = Atoms {
        selection: atom("XdndSelection")?,
        uri_list: atom("text/uri-list")?,
        enter: atom("XdndEnter")?,
        position: atom("XdndPosition")?,
        status: atom("XdndStatus")?,
        drop: atom("XdndDrop")?,
        finished: atom("XdndFinished")?,
        copy: atom("XdndActionCopy")?,
    };
    let root = connection.setup().roots[screen].root;
    let source = connection.generate_id()?;
    let (kind, none) = (WindowClass::INPUT_OUTPUT, CreateWindowAux::new());
    connection.create_window(0, source, root, 0, 0, 1, 1, 0, kind, 0, &none)?;
    connection.set_selection_owner(source, atoms.selection, x11rb::CURRENT_TIME)?;

    let send = |kind: u32, data: [u32; 4]| -> Result<(), Box<dyn Error>> {
        let [a, b, c, d] = data;
        let message = ClientMessageEvent::new(32, target, kind, [source, a, b, c, d]);
        connection.send_event(false, target, EventMask::NO_EVENT, message)?;
        Ok(connection.flush()?)
    };
    send(atoms.enter, [VERSION << 24, atoms.uri_list, 0, 0])?;
    let place = u32::from(x) << 16 | u32::from(y);
    let start = Instant::now();
    loop {
        // A hand keeps moving, so that a message which did not wake the program is no end.
        send(atoms.position, [0, place, x11rb::CURRENT_TIME, atoms.copy])?;
        match serve_until(&connection, &atoms, atoms.status, path, MOVEMENT) {
            Err(error) if start.elapsed() > PATIENCE => return Err(error),
            Err(_) => {}
            Ok(()) => break,
        }
    }
    send(atoms.drop, [0, x11rb::CURRENT_TIME, 0, 0])?;
    serve_until(&connection, &atoms, atoms.finished, path, PATIENCE)
}

/// Hands the path to whoever asks for it until a message of this kind comes.
fn serve_until(
    connection: &RustConnection,
    atoms: &Atoms,
    kind: u32,
    path: &Path,
    patience: Duration,
) -> Result<(), Box<dyn Error>> {
    let start = Instant::now();
    while start.elapsed() < patience {
        match connection.poll_for_event()? {
            None => std::thread::sleep(Duration::from_millis(5)),
            Some(Event::ClientMessage(message)) if message.type_ == kind => return Ok(()),
            Some(Event::SelectionRequest(request)) => {
                let text = format!("file://{}\r\n", path.display());
                let property = match request.property {
                    0 => request.target,
                    property => property,
                };
                let (mode, window) = (PropMode::REPLACE, request.requestor);
                connection.change_property8(
                    mode,
                    window,
                    property,
                    atoms.uri_list,
                    text.as_bytes(),
                )?;
                let notice = SelectionNotifyEvent {
                    response_type: SELECTION_NOTIFY_EVENT,
                    sequence: 0,
                    time: request.time,
                    requestor: window,
                    selection: request.selection,
                    target: request.target,
                    property,
                };
                connection.send_event(false, window, EventMask::NO_EVENT, notice)?;
                connection.flush()?;
            }
            Some(_) => {}
        }
    }
    let name = connection.get_atom_name(kind)?.reply()?.name;
    Err(format!("no {} came", String::from_utf8_lossy(&name)).into())
}
