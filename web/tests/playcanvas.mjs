// PlayCanvas in Chromium: what its loader makes of compressed files is what it makes of plain ones.
//
//   node playcanvas.mjs TUTTE BUILD_FOLDER
import {testLoaderPage} from './loader_page.mjs';

testLoaderPage('playcanvas', 'playcanvas.html');
