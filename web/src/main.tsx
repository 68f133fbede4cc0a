import { render } from 'preact';
import './page.css';

const place = document.getElementById('page');
if (place) {
  render(<p>snapthrough</p>, place);
}
