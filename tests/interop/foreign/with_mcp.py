"""coppeliasim-mcp 0.4: its tools, called as a language model calls them, over standard input and output."""

import asyncio
import json
import os
import sys
import tempfile

from mcp import ClientSession, StdioServerParameters
from mcp.client.stdio import stdio_client

PROGRAM = os.path.join(os.path.dirname(sys.executable), 'coppeliasim-mcp')


async def stopped(call):
    for _ in range(500):
        if await call('estado_simulacion') == 'Estado: detenida':
            return
        await asyncio.sleep(0.02)
    raise AssertionError('the simulation does not stop')


async def build(call):
    assert await call('estado_simulacion') == 'Estado: detenida'
    assert json.loads(await call('listar_objetos', tipo='joint'))['total'] == 6
    await call('crear_primitiva', forma='cubo', tamano_x=0.1, tamano_y=0.2, tamano_z=0.3, x=2, y=0, z=0.15, alias='caja')
    said = await call('fijar_dinamica', nombre='caja', dinamico=True, densidad=500)
    assert 'masa=3.0000 kg' in said, said
    assert 'rechazó' not in await call('fijar_color', nombre='caja', r=1, g=0, b=0)
    await call('fijar_orientacion', nombre='caja', alfa=0, beta=0, gamma=0.3)
    angles = json.loads(await call('obtener_orientacion', nombre='caja'))['orientacion_rad']
    assert abs(angles[2] - 0.3) < 1e-9, angles
    assert 'modo velocidad' in await call(
        'crear_junta', alias='eje', tipo='rotativa', eje='z', padre='caja', z=0.2, modo='velocidad', par_maximo=5)
    await call('crear_primitiva', forma='cilindro', tamano_x=0.1, tamano_y=0.1, tamano_z=0.02, x=2, y=0, z=0.36, alias='plato')
    await call('fijar_dinamica', nombre='plato', dinamico=True, densidad=500)
    assert await call('emparentar_objeto', objeto='plato', padre='caja/eje') == "'/plato' ahora cuelga de '/eje'."
    assert 'rechazó' not in await call('crear_union_rigida', alias='union', padre='caja')
    await call('crear_sensor_proximidad', alias='ojo', x=1.5, y=0, z=0.15)
    await call('fijar_detectable', nombre='caja')
    seen = json.loads(await call('comprobar_sensor_proximidad', sensor='ojo'))
    assert seen['objeto_detectado'] == '/caja' and 0.4 < seen['distancia'] < 0.5, seen


async def simulate(call):
    await call('iniciar_simulacion')
    await call('paso_simulacion', pasos=1)
    await call('fijar_velocidad_junta', junta='caja/eje', velocidad=1)
    before = json.loads(await call('obtener_posicion_junta', junta='caja/eje'))['posicion']
    said = await call('paso_simulacion', pasos=20)
    assert said.startswith('Avanzados 20 pasos de 0.0500 s.'), said
    turned = json.loads(await call('obtener_posicion_junta', junta='caja/eje'))['posicion'] - before
    assert 0.9 < turned < 1.1, turned
    assert isinstance(json.loads(await call('obtener_fuerza_junta', junta='caja/eje'))['fuerza'], float)
    assert json.loads(await call('leer_sensor_proximidad', sensor='ojo'))['detectado'] is True
    await call('pausar_simulacion')
    await call('detener_simulacion')
    await stopped(call)


async def files(call, folder):
    path = os.path.join(folder, 'x.ttt')
    assert 'Escena guardada' in await call('guardar_escena', ruta=path)
    await call('eliminar_objeto', nombre='caja')
    assert 'rechazó la operación: in sim._getObject: object does not exist' in await call('obtener_posicion', nombre='caja')
    assert 'Escena cargada' in await call('cargar_escena', ruta=path)
    place = json.loads(await call('obtener_posicion', nombre='caja'))['posicion']
    assert abs(place[0] - 2) < 1e-3, place
    assert 'rechazó' not in await call('cerrar_escena')
    assert json.loads(await call('listar_objetos', tipo='joint'))['total'] == 0


async def main(port):
    with tempfile.TemporaryDirectory() as folder:
        settings = dict(os.environ, COPPELIA_PUERTO=port, COPPELIA_DIRECTORIO_ESCENAS=folder, COPPELIA_DIRECTORIO_MODELOS=folder)
        server = StdioServerParameters(command=PROGRAM, env=settings)
        async with stdio_client(server) as (read, write), ClientSession(read, write) as session:
            await session.initialize()

            async def call(tool, **arguments):
                return (await session.call_tool(tool, arguments)).content[0].text

            await build(call)
            await simulate(call)
            await files(call, folder)


asyncio.run(main(sys.argv[1]))
